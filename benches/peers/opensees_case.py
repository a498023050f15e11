"""The elastic example in OpenSees: elasticBeamColumn with the corotational transformation and consistent mass (engineering strains,
one axial strain per element, no rotary inertia).

The projectile is a node of its own on the midspan node; the spring between them is elastic under compression only, after the standoff.
"""

import os
import tempfile

import numpy as np
import openseespy.opensees as ops

import case as c

EA, EI = c.YOUNG * c.AREA, c.YOUNG * c.INERTIA


def model(case):
    """Builds it; tags of the midspan node, the projectile's node and the contact's element."""
    count = case["elements"]
    size = c.LENGTH / count
    ops.wipe()
    ops.model("basic", "-ndm", 2, "-ndf", 3)
    for k in range(count + 1):
        ops.node(k + 1, k * size, 0.0)
    middle, mass = count // 2 + 1, count + 2
    ops.node(mass, 0.5 * c.LENGTH, 0.0)
    ops.mass(mass, c.PROJECTILE, c.PROJECTILE, 0.0)
    ops.fix(mass, 1, 0, 1)
    if not case["free"]:
        ops.fix(1, 1, 1, 1)
        ops.fix(count + 1, 1, 1, 1)
    ops.geomTransf("Corotational", 1)
    for k in range(1, count + 1):
        material = (c.AREA, c.YOUNG, c.INERTIA, 1)
        ops.element("elasticBeamColumn", k, k, k + 1, *material, "-mass", c.MASS_PER_LENGTH, "-cMass")
    # Deformations are the projectile's less the beam's; the standoff is a deformation without force.
    reach = 100.0
    strains, stresses = (-reach, 0.0, c.STANDOFF, c.STANDOFF + reach), (0.0, 0.0, 0.0, c.SPRING * reach)
    ops.uniaxialMaterial("ElasticMultiLinear", 1, "-strain", *strains, "-stress", *stresses)
    ops.element("zeroLength", count + 1, middle, mass, "-mat", 1, "-dir", 2)
    ops.setNodeVel(mass, 2, c.SPEED, "-commit")
    return middle, mass, count + 1


def analysis(options):
    """Chooses solver, algorithm and integrator."""
    ops.constraints("Plain")
    ops.numberer("RCM")
    ops.system(options.get("system", "ProfileSPD"))
    ops.test("NormDispIncr", options.get("tolerance", 1e-8), 30)
    ops.algorithm(*options.get("algorithm", ["Newton"]))
    ops.integrator(*options.get("integrator", ["Newmark", 0.5, 0.25]))
    ops.analysis("Transient")


def energy(count, middle, mass):
    """Total energy of the present state [J]."""
    size = c.LENGTH / count
    total = 0.5 * c.PROJECTILE * ops.nodeVel(mass, 2) ** 2
    press = max(ops.nodeDisp(mass, 2) - ops.nodeDisp(middle, 2) - c.STANDOFF, 0.0)
    total += 0.5 * c.SPRING * press**2
    transverse = c.MASS_PER_LENGTH * size / 420.0 * np.array(
        [
            [156, 22 * size, 54, -13 * size],
            [22 * size, 4 * size**2, 13 * size, -3 * size**2],
            [54, 13 * size, 156, -22 * size],
            [-13 * size, -3 * size**2, -22 * size, 4 * size**2],
        ]
    )
    for k in range(1, count + 1):
        (u1, v1, t1), (u2, v2, t2) = ops.nodeDisp(k), ops.nodeDisp(k + 1)
        chord = np.array([size + u2 - u1, v2 - v1])
        stretch = np.hypot(*chord) - size
        angle = np.arctan2(chord[1], chord[0])
        turns = [np.remainder(t - angle + np.pi, 2.0 * np.pi) - np.pi for t in (t1, t2)]
        total += 0.5 * EA / size * stretch**2
        total += 2.0 * EI / size * (turns[0] ** 2 + turns[0] * turns[1] + turns[1] ** 2)
        (a1, b1, w1), (a2, b2, w2) = ops.nodeVel(k), ops.nodeVel(k + 1)
        total += c.MASS_PER_LENGTH * size / 6.0 * (a1**2 + a1 * a2 + a2**2)
        bend = np.array([b1, w1, b2, w2])
        total += 0.5 * bend @ transverse @ bend
    return total


def run_free(case, options):
    """A run without supports, in parts, after each of which its energy is evaluated."""
    middle, mass, _ = model(case)
    analysis(options)
    part = max(round(c.SAMPLE / case["step"]), 1)
    steps = round(case["end"] / case["step"])
    user, error, done = 0.0, 0.0, 0
    while done < steps:
        start = c.user_time()
        failed = ops.analyze(min(part, steps - done), case["step"]) != 0
        user += c.user_time() - start
        done += min(part, steps - done)
        error = max(error, abs(energy(case["elements"], middle, mass) / c.ENERGY - 1.0))
        if failed or not error < 1e3:
            return {"user": user, "steps": steps, "finished": False, "energy_error": None}
    return {"user": user, "steps": steps, "finished": True, "energy_error": float(error)}


def run(case, options):
    """One run of the case."""
    if case["free"]:
        return run_free(case, options)
    steps = round(case["end"] / case["step"])
    with tempfile.TemporaryDirectory() as folder:
        middle, mass, spring = model(case)
        analysis(options)

        def path(name):
            return os.path.join(folder, name)

        nodes = ("-node", middle, mass, "-dof", 2)
        ops.recorder("Node", "-file", path("places"), *nodes, "disp")
        ops.recorder("Node", "-file", path("speeds"), *nodes, "vel")
        ends = ("-node", 1, case["elements"] + 1, "-dof", 1, 2, 3)
        ops.recorder("Node", "-file", path("reactions"), *ends, "reaction")
        ops.recorder("Element", "-file", path("forces"), "-ele", middle - 1, "localForce")
        ops.recorder("Element", "-file", path("contact"), "-ele", spring, "force")
        start = c.user_time()
        finished = ops.analyze(steps, case["step"]) == 0
        ops.wipe()  # writes what is left of the records
        answer = {"user": c.user_time() - start, "steps": steps, "finished": finished}
        places = np.loadtxt(path("places"))
    force = c.SPRING * np.maximum(places[:, 1] - places[:, 0] - c.STANDOFF, 0.0)
    answer["finished"] = finished and bool(np.isfinite(places).all())
    return answer | {"f_max": c.crest(force), "u_max": c.crest(places[:, 0])}


if __name__ == "__main__":
    c.main(run)
