"""What `percuss export` writes, read back by VTK's own reader."""

from xml.etree import ElementTree

import numpy as np
import percuss
import pytest

from conftest import SCENARIOS

vtk = pytest.importorskip("vtk", reason="VTK is not there: pip install vtk")
from vtk.util.numpy_support import vtk_to_numpy  # noqa: E402

CANTILEVER = """
[material.steel]
preset = "steel"
[section.bar]
shape = "rectangle"
width = "20 mm"
depth = "40 mm"
[beam.arm]
points = [[0, 0], ["1 m", 0]]
elements = 8
material = "steel"
section = "bar"
[support.root]
at = "arm.start"
kind = "clamp"
[load.tip]
kind = "point"
at = "arm.end"
force = ["2 kN", "-50 N"]
[time]
start = "static"
end = "1 ms"
step = "0.1 ms"
"""

SPINNING = """
[material.steel]
preset = "steel"
[section.bar]
shape = "rectangle"
width = "20 mm"
depth = "40 mm"
[beam.rod]
points = [[0, 0], ["1 m", 0]]
elements = 4
material = "steel"
section = "bar"
[initial]
velocity = [3, -1]
spin = 5
about = [0.25, 0]
[time]
end = "1 ms"
step = "0.1 ms"
"""


class Reader:
    """A file at its instants."""

    def __init__(self, path):
        self.reader = vtk.vtkHDFReader()
        assert self.reader.CanReadFile(str(path))
        self.reader.SetFileName(str(path))
        self.reader.UpdateInformation()
        information = self.reader.GetOutputInformation(0)
        self.times = np.array(information.Get(vtk.vtkStreamingDemandDrivenPipeline.TIME_STEPS()))

    def at(self, t):
        self.reader.UpdateTimeStep(float(t))
        self.data = self.reader.GetOutput()
        assert self.data.IsA("vtkPolyData")
        return self

    @property
    def points(self):
        return vtk_to_numpy(self.data.GetPoints().GetData()) if self.data.GetNumberOfPoints() else np.zeros((0, 3))

    def __getitem__(self, name):
        return vtk_to_numpy(self.data.GetPointData().GetArray(name))


def test_section_forces_and_stresses_are_those_of_a_cantilever(tmp_path):
    result = percuss.run(percuss.Scenario.from_toml(CANTILEVER))
    assert result.export(tmp_path / "out") == ["beams.vtkhdf", "supports.vtkhdf"]
    # The clamp stands where the beam begins, as lines of its own.
    clamp = Reader(tmp_path / "out" / "supports.vtkhdf").at(0.0)
    assert clamp.data.GetNumberOfLines() > 3 and clamp.data.GetNumberOfPolys() == 0
    assert np.abs(clamp.points[:, 0]).max() < 0.05 and np.ptp(clamp.points[:, 1]) >= 0.04
    beam = Reader(tmp_path / "out" / "beams.vtkhdf").at(0.0)
    x, y = beam.points[:, 0], beam.points[:, 1]
    width, depth, length = 0.02, 0.04, 1.0
    area, inertia = width * depth, width * depth**3 / 12
    # Beam theory of second order: the axial force of 2 kN takes part of the moment, w' of the tip some per mille.
    moment = beam["moment"]
    tension = 2000.0
    young = 210e9
    k = np.sqrt(tension / (young * inertia))
    exact = -50.0 / k * np.sinh(k * (length - x)) / np.cosh(k * length)
    assert np.abs(moment - exact).max() < 2e-3 * 50.0
    assert np.abs(beam["shear_force"]).max() == pytest.approx(50.0, rel=0.02)
    assert beam["axial_force"] == pytest.approx(tension, rel=1e-3)
    # Pulled down, the upper fibres are in tension; across the section the stress is a straight line.
    root = np.abs(x) < 1e-9
    assert root.sum() == 3
    upper, axis, lower = (beam["stress"][root][np.argsort(-y[root])]).tolist()
    bending = np.abs(exact[root][0]) * 0.5 * depth / inertia
    assert upper == pytest.approx(tension / area + bending, rel=2e-3)
    assert lower == pytest.approx(tension / area - bending, rel=5e-3)
    assert axis == pytest.approx(tension / area, rel=1e-3)
    assert beam["largest_stress"][root] == pytest.approx(upper, rel=1e-5)
    stress = result.summary["section_forces"]["arm"]["stress"]["max"]["value"]
    assert beam["largest_stress"].max() == pytest.approx(stress, rel=1e-3)


def test_velocities_of_the_surface_are_those_of_a_rigid_motion(tmp_path):
    result = percuss.run(percuss.Scenario.from_toml(SPINNING))
    result.export(tmp_path / "out")
    beam = Reader(tmp_path / "out" / "beams.vtkhdf").at(0.0)
    x, y = beam.points[:, 0], beam.points[:, 1]
    expected = np.stack([3.0 - 5.0 * y, -1.0 + 5.0 * (x - 0.25), 0 * x], axis=1)
    assert np.abs(beam["velocity"] - expected).max() < 1e-5
    assert np.ptp(y) == pytest.approx(0.04, rel=1e-6)
    assert beam.data.GetNumberOfPolys() > 0 and beam.data.GetNumberOfLines() == 0
    cells = vtk.vtkCellSizeFilter()
    cells.SetInputData(beam.data)
    cells.Update()
    assert vtk_to_numpy(cells.GetOutput().GetCellData().GetArray("Area")).sum() == pytest.approx(0.04, rel=1e-5)


def test_every_frame_and_every_contact_is_there(elastic, tmp_path):
    result = percuss.run(elastic, out=tmp_path / "run")
    names = percuss.open(tmp_path / "run").export(tmp_path / "out")
    assert names == ["beams.vtkhdf", "bodies.vtkhdf", "supports.vtkhdf", "contacts.vtkhdf"]
    fields = result.fields
    beam, contacts = (Reader(tmp_path / "out" / f"{name}.vtkhdf") for name in ("beams", "contacts"))
    assert np.array_equal(beam.times, fields.time) and np.array_equal(contacts.times, fields.time)
    for t in fields.time[:: len(fields) // 7]:
        frame = fields.index(t)
        expected = np.concatenate([c.points for b in fields.beams for c in b.curves(fields.displacement[frame].astype(float))])
        own = beam.at(t).points[:, :2]
        # The section has no depth: all points lie on the axis.
        far = np.abs(own[:, None, 0] - expected[None, :, 0]).argmin(axis=1)
        assert np.abs(own - expected[far]).max() < 0.02
        here = fields.contacts(frame)
        assert contacts.at(t).data.GetNumberOfPoints() == len(here)
        if here:
            assert contacts["force"][0, :2] == pytest.approx(here[0].force, rel=1e-6)
            assert contacts.points[0, :2] == pytest.approx(here[0].position, rel=1e-6)
    row = np.abs(result.time - fields.time[frame]).argmin()
    assert result["contact.mass.force"][row] == pytest.approx(np.linalg.norm(here[0].force) if here else 0.0, rel=0.05, abs=1.0)


@pytest.mark.parametrize("name", ["rigid-clamped-e0.5", "rigid-clamped-e0.5-paper", "rigid-clamped-e0"])
def test_impulses_and_forces_have_arrays_of_their_own(name, tmp_path):
    result = percuss.run(SCENARIOS / "paper" / f"{name}.toml", time__end="2 ms")
    result.export(tmp_path / "out")
    contacts = Reader(tmp_path / "out" / "contacts.vtkhdf")
    impulse = result.summary["contact"]["hammer"]["impacts"][0]["impulse"]
    forces, impulses = 0.0, 0.0
    for frame, t in enumerate(result.fields.time):
        here = result.fields.contacts(frame)
        if contacts.at(t).data.GetNumberOfPoints() == 0:
            assert not here
            continue
        for key, impulsive in (("force", False), ("impulse", True)):
            expected = [c.force if c.impulsive == impulsive else np.zeros(2) for c in here]
            assert contacts[key][:, :2] == pytest.approx(np.array(expected), rel=1e-6)
        forces = max(forces, float(np.abs(contacts["force"]).max()))
        impulses = max(impulses, float(np.abs(contacts["impulse"]).max()))
    assert impulses == pytest.approx(impulse, rel=1e-6)
    # Persistent contact follows a plastic impact: its force is that of the deceleration, far below impulse over step.
    assert (forces > 0) == (name == "rigid-clamped-e0") and forces < 0.1 * impulse / 1e-5


def test_lists_of_files_say_the_same(tmp_path):
    scenario = percuss.load(SCENARIOS / "disc-chain.toml")
    result = percuss.run(scenario, shapes=10)
    names = result.export(tmp_path / "one")
    assert [n.removesuffix(".pvd") for n in result.export(tmp_path / "many", format="pvd")] == [n.removesuffix(".vtkhdf") for n in names]
    for name in names:
        series = Reader(tmp_path / "one" / name)
        sets = ElementTree.parse(tmp_path / "many" / name.replace(".vtkhdf", ".pvd")).getroot().findall("Collection/DataSet")
        assert [float(s.get("timestep")) for s in sets] == series.times.tolist()
        for t, entry in zip(series.times, sets):
            reader = vtk.vtkXMLPolyDataReader()
            reader.SetFileName(str(tmp_path / "many" / entry.get("file")))
            reader.Update()
            one, other = series.at(t).data, reader.GetOutput()
            assert one.GetNumberOfPoints() == other.GetNumberOfPoints()
            assert [k.GetNumberOfCells() for k in (one.GetVerts(), one.GetLines(), one.GetPolys())] == [
                k.GetNumberOfCells() for k in (other.GetVerts(), other.GetLines(), other.GetPolys())
            ]
            if not one.GetNumberOfPoints():
                continue
            assert np.array_equal(series.points, vtk_to_numpy(other.GetPoints().GetData()))
            assert one.GetPointData().GetNumberOfArrays() == other.GetPointData().GetNumberOfArrays()
            for k in range(one.GetPointData().GetNumberOfArrays()):
                array = one.GetPointData().GetArray(k)
                assert np.array_equal(vtk_to_numpy(array), vtk_to_numpy(other.GetPointData().GetArray(array.GetName())))
            for kind in ("GetLines", "GetPolys"):
                ids = [vtk_to_numpy(getattr(d, kind)().GetConnectivityArray()) for d in (one, other)]
                assert np.array_equal(*ids)
        kind = name.removesuffix(".vtkhdf")
        field = other.GetFieldData().GetAbstractArray({"beams": "beam", "bodies": "body", "contacts": "contact", "supports": "support"}[kind] + "_names")
        assert [field.GetValue(k) for k in range(field.GetNumberOfValues())] == [x["name"] for x in result.fields.scene[kind]]


@pytest.mark.parametrize("name", ["disc-chain", "gapped-pipe", "tapping-cantilever", "oblique-throw", "crossing-beams"])
def test_scenes_of_all_kinds_can_be_read(name, tmp_path):
    scenario = percuss.load(SCENARIOS / f"{name}.toml")
    result = percuss.run(scenario, shapes=20)
    names = result.export(tmp_path / "out")
    assert names[0] == "beams.vtkhdf"
    for file in names:
        reader = Reader(tmp_path / "out" / file)
        assert np.array_equal(reader.times, result.fields.time)
        for t in reader.times:
            assert np.isfinite(reader.at(t).points).all()
    if "bodies.vtkhdf" in names and name == "disc-chain":
        discs = [b for b in result.fields.scene["bodies"] if b["kind"] == "disc"]
        bodies = Reader(tmp_path / "out" / "bodies.vtkhdf").at(result.fields.time[-1])
        assert bodies.data.GetNumberOfPolys() == len(discs)
        moved = result.fields.displacement[-1][result.fields.stations, :2] + discs[0]["position"]
        rim = bodies.points[:48, :2]
        assert np.linalg.norm(rim - moved, axis=1) == pytest.approx(discs[0]["radius"], rel=1e-4)


def test_folders_that_are_no_exports_stay(elastic, tmp_path):
    result = percuss.run(elastic)
    (tmp_path / "mine").mkdir()
    (tmp_path / "mine" / "beams.vtkhdf").write_text("mine")
    with pytest.raises(ValueError, match="mine"):
        result.export(tmp_path / "mine")
    assert (tmp_path / "mine" / "beams.vtkhdf").read_text() == "mine"
    result.export(tmp_path / "own")
    result.export(tmp_path / "own")
    with pytest.raises(ValueError, match="vtkhdf"):
        result.export(tmp_path / "own", format="stl")
    with pytest.raises(ValueError, match="record.shapes"):
        percuss.run(elastic, shapes=0).export(tmp_path / "none")
