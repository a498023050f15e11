"""The elastic example in Exudyn: ANCFCable2D (Euler-Bernoulli, engineering strains, no rotary inertia), its build without range checks.

The projectile is a mass on a coordinate of its own; the spring is a limit stop between that coordinate and the midspan node's.
"""

import sys
import warnings

sys.exudynFast = True
warnings.simplefilter("ignore")

import exudyn as exu  # noqa: E402
import numpy as np  # noqa: E402
from exudyn.itemInterface import (  # noqa: E402
    CoordinateConstraint,
    Mass1D,
    MarkerNodeCoordinate,
    Node1D,
    NodeGenericData,
    NodePoint2DSlope1,
    NodePointGround,
    ObjectANCFCable2D,
    ObjectConnectorCoordinateSpringDamperExt,
    SensorBody,
    SensorNode,
    SensorObject,
)

import case as c  # noqa: E402

OUT = exu.OutputVariableType


def model(case, options):
    """The system, its beam's nodes, and the sensors by name."""
    count, free = case["elements"], case["free"]
    system = exu.SystemContainer().AddSystem()
    size = c.LENGTH / count
    nodes = [
        system.AddNode(NodePoint2DSlope1(referenceCoordinates=[k * size, 0, 1, 0])) for k in range(count + 1)
    ]
    cables = [
        system.AddObject(
            ObjectANCFCable2D(
                length=size,
                massPerLength=c.MASS_PER_LENGTH,
                bendingStiffness=c.YOUNG * c.INERTIA,
                axialStiffness=c.YOUNG * c.AREA,
                nodeNumbers=[nodes[k], nodes[k + 1]],
                useReducedOrderIntegration=options.get("order", 2),
            )
        )
        for k in range(count)
    ]

    def marker(node, coordinate):
        return system.AddMarker(MarkerNodeCoordinate(nodeNumber=node, coordinate=coordinate))

    ground = marker(system.AddNode(NodePointGround()), 0)
    held = []
    for end in [] if free else [nodes[0], nodes[-1]]:
        for coordinate in (0, 1, 3):
            markers = [ground, marker(end, coordinate)]
            held.append(system.AddObject(CoordinateConstraint(markerNumbers=markers)))
    start = {"initialCoordinates": [-c.STANDOFF], "initialVelocities": [c.SPEED]}
    mass = system.AddNode(Node1D(referenceCoordinates=[0.0], **start))
    system.AddObject(Mass1D(mass=c.PROJECTILE, nodeNumber=mass))
    middle = nodes[count // 2]
    states = system.AddNode(NodeGenericData(initialCoordinates=[0, 0, 0], numberOfDataCoordinates=3))
    spring = system.AddObject(
        ObjectConnectorCoordinateSpringDamperExt(
            markerNumbers=[marker(middle, 1), marker(mass, 0)],
            nodeNumber=states,
            limitStopsUpper=0.0,
            limitStopsLower=-1e6,
            limitStopsStiffness=c.SPRING,
            useLimitStops=True,
        )
    )

    def of_node(node, what):
        return system.AddSensor(SensorNode(nodeNumber=node, outputVariableType=what, storeInternal=True))

    def of_object(number, what):
        return system.AddSensor(SensorObject(objectNumber=number, outputVariableType=what, storeInternal=True))

    if free:
        points = nodes + [mass]
        sensors = {
            "places": [of_node(n, OUT.Coordinates) for n in points],
            "speeds": [of_node(n, OUT.Coordinates_t) for n in points],
        }
    else:
        sensors = {"force": of_object(spring, OUT.Force), "middle": of_node(middle, OUT.Coordinates)}
        of_node(middle, OUT.Coordinates_t)
        of_node(mass, OUT.Coordinates)
        of_node(mass, OUT.Coordinates_t)
        for constraint in held:
            of_object(constraint, OUT.Force)
        for what in (OUT.ForceLocal, OUT.TorqueLocal):
            body = {"bodyNumber": cables[count // 2 - 1], "localPosition": [size, 0, 0]}
            system.AddSensor(SensorBody(**body, outputVariableType=what, storeInternal=True))
    system.Assemble()
    return system, sensors


def energies(case, places, speeds):
    """Total energy of each sampled state [J]; arrays of shape (n_nodes, n_rows, 4), the projectile last."""
    count = case["elements"]
    size = c.LENGTH / count
    points, weights = np.polynomial.legendre.leggauss(6)
    total = 0.5 * c.PROJECTILE * speeds[-1][:, 0] ** 2
    press = np.maximum(places[-1][:, 0] - places[count // 2][:, 1], 0.0)
    total += 0.5 * c.SPRING * press**2
    for k in range(count):
        ends = [np.array([m * size, 0.0, 1.0, 0.0]) + places[m] for m in (k, k + 1)]
        q = np.concatenate(ends, axis=1).reshape(-1, 4, 2)
        v = np.concatenate([speeds[k], speeds[k + 1]], axis=1).reshape(-1, 4, 2)
        for point, weight in zip(0.5 * (points + 1.0), 0.5 * weights * size):
            x = point
            shape = np.array([1 - 3 * x**2 + 2 * x**3, size * (x - 2 * x**2 + x**3)])
            shape = np.append(shape, [3 * x**2 - 2 * x**3, size * (x**3 - x**2)])
            slope = np.array([(6 * x**2 - 6 * x) / size, 1 - 4 * x + 3 * x**2, (6 * x - 6 * x**2) / size, 3 * x**2 - 2 * x])
            bend = np.array([(12 * x - 6) / size**2, (6 * x - 4) / size, (6 - 12 * x) / size**2, (6 * x - 2) / size])
            velocity, r1, r2 = (np.einsum("i,nij->nj", w, a) for w, a in ((shape, v), (slope, q), (bend, q)))
            stretch = np.sqrt((r1**2).sum(1))
            turn = (r1[:, 0] * r2[:, 1] - r1[:, 1] * r2[:, 0]) / stretch**2
            density = c.MASS_PER_LENGTH * (velocity**2).sum(1)
            density += c.YOUNG * c.AREA * (stretch - 1) ** 2 + c.YOUNG * c.INERTIA * turn**2
            total = total + 0.5 * weight * density
    return total


def run(case, options):
    """One run of the case."""
    system, sensors = model(case, options)
    steps = round(case["end"] / case["step"])
    settings = exu.SimulationSettings()
    time = settings.timeIntegration
    time.numberOfSteps, time.endTime = steps, case["end"]
    time.adaptiveStep = False
    time.generalizedAlpha.spectralRadius = options.get("radius", 1.0)
    time.newton.useModifiedNewton = options.get("modified", True)
    # In newtons: with the default tolerance (1e-10) round-off in the axial forces prevents convergence.
    time.newton.absoluteTolerance = 1e-3
    time.newton.relativeTolerance = options.get("tolerance", 1e-8)
    settings.solution.file.write = False
    settings.solution.sensors.writePeriod = c.SAMPLE if case["free"] else case["step"]
    settings.show.globalTimers = False
    sparse = options.get("sparse", case["elements"] > 20)
    kind = exu.LinearSolverType
    settings.linearSolver.solverType = kind.EigenSparse if sparse else kind.EXUdense
    solver = getattr(exu.DynamicSolverType, options.get("solver", "GeneralizedAlpha"))
    start = c.user_time()
    try:
        system.SolveDynamic(settings, solverType=solver)
        finished = True
    except Exception:  # it says so itself
        finished = False
    answer = {"user": c.user_time() - start, "steps": steps, "finished": finished}

    def stored(sensor):
        return system.GetSensorStoredData(sensor)[:, 1:]

    if case["free"]:
        places, speeds = ([stored(s) for s in sensors[key]] for key in ("places", "speeds"))
        energy = energies(case, places, speeds)
        error = float(np.max(np.abs(energy / c.ENERGY - 1.0)))
        return answer | {"energy_error": error, "finished": finished and bool(np.isfinite(error))}
    force, place = np.abs(stored(sensors["force"])[:, 0]), stored(sensors["middle"])[:, 1]
    answer["finished"] = finished and bool(np.isfinite(force).all() and np.isfinite(place).all())
    return answer | {"f_max": c.crest(force), "u_max": c.crest(place)}


if __name__ == "__main__":
    c.main(run)
