"""Discs on a slope (ANGLE) or sheared between bumpy walls under a load (INERTIA), as LAMMPS runs them.

Environment: ANGLE in degrees or INERTIA; SEED. SI units. Discs are spheres that
stay in a plane, with the mass and the inertia of discs of 1 m.
"""
import math
import os
import random

from yade import *  # the program offers its classes to a script by this name

angle, inertia = os.environ.get("ANGLE"), float(os.environ.get("INERTIA", 0))
random.seed(int(os.environ["SEED"]))
D, density, gravity = 0.002, 2500.0, 9.81
rows = 15 if angle else 20
long, h0 = rows * D, rows * D
high = 2 * h0
load = density * 0.8 * gravity * 15 * D
speed = inertia * math.sqrt(load / density) * h0 / D

# springs a thousand times stiffer than the load; restitution about 0.5
stiffness = 1000 * load
mass = density * math.pi * D**2 / 4
contact_time = math.pi * math.sqrt(0.5 * mass / stiffness)
damping = 1.386 / contact_time * 0.5 * mass
# two bodies in contact are springs in a row, so that each has twice the stiffness of the contact
spring = {"kn": 2 * stiffness, "ks": stiffness, "cn": 2 * damping, "cs": 0.0}
material = O.materials.append(ViscElMat(frictionAngle=math.atan(0.5), density=density, **spring))
O.periodic = True
O.cell.hSize = Matrix3(long, 0, 0, 0, 4 * high, 0, 0, 0, 10 * D)


def disc(x, y, radius, blocked):
    body = utils.sphere((x, y + D, 5 * D), radius, material=material)
    body.state.mass = density * math.pi * radius**2
    body.state.inertia = Vector3(1, 1, 1) * 0.5 * body.state.mass * radius**2
    body.state.blockedDOFs = blocked
    return O.bodies.append(body)


lower = [disc((k + 0.5) * D, -0.5 * D, 0.5 * D, "xyzXYZ") for k in range(rows)]
upper = [] if angle else [disc((k + 0.5) * D, high + 0.5 * D, 0.5 * D, "xyzXYZ") for k in range(rows)]
# grains of 0.8 to 1.2 diameters on a loose lattice, each moved at random
count = int(long * h0 * 0.80 / (math.pi * D**2 / 4 * 1.0133))
along = int(long / (1.25 * D))
sizes = [0.8 + 0.4 * ((k * 0.6180339887) % 1) for k in range(count)]
random.shuffle(sizes)
grains = []
for k, size in enumerate(sizes):
    x = (k % along + random.uniform(0.0, 0.04)) * long / along
    y = 0.7 * D + (k // along + random.uniform(0.0, 0.04)) * 1.22 * D
    grains.append(disc(x, y, 0.5 * size * D, "zXY"))
    O.bodies[grains[-1]].state.vel = (6 * math.sqrt(gravity * D) if angle else speed * y / high, 0, 0)

O.dt = contact_time / 15
slope = math.radians(float(angle or 0))
down = (gravity * math.sin(slope), -gravity * math.cos(slope), 0) if angle else (0, 0, 0)
across, drag, weight, samples = 0.0, 0.0, 0.0, 0


def measure():
    """Force of the grains on the wall at rest."""
    global drag, weight, samples
    force = sum((O.forces.f(k) for k in lower), Vector3(0, 0, 0))
    drag, weight, samples = drag + force[0], weight - force[1], samples + long


def press():
    """The upper wall is one piece: it slides at its speed, and load, grains and a weak damping move it across."""
    global across
    force = sum(O.forces.f(k)[1] for k in upper) - load * long - 2 * mass * math.sqrt(load / density) / D * rows * across
    across += force / (rows * mass) * O.dt
    for k in upper:
        O.bodies[k].state.vel = (speed, across, 0)


O.engines = [
    ForceResetter(),
    InsertionSortCollider([Bo1_Sphere_Aabb()], verletDist=0.2 * D, allowBiggerThanPeriod=True),
    InteractionLoop(
        [Ig2_Sphere_Sphere_ScGeom()],
        [Ip2_ViscElMat_ViscElMat_ViscElPhys()],
        [Law2_ScGeom_ViscElPhys_Basic()],
    ),
    *([] if angle else [PyRunner(command="press()", iterPeriod=1), PyRunner(command="measure()", iterPeriod=10)]),
    NewtonIntegrator(damping=0.0, gravity=down),
]

# from the second half on the slope, or from a shear of 20 to one of 60, in pictures as LAMMPS writes them
pictures = 20 if angle else 40
every = int((20 * math.sqrt(D / gravity) if angle else h0 / speed) / O.dt)
O.run(20 * every, True)
drag, weight, samples = 0.0, 0.0, 0
with open("slope.dump" if angle else "shear.dump", "w") as out:
    for picture in range(pictures + 1):
        states = [O.bodies[k].state for k in grains]
        out.write(f"ITEM: TIMESTEP\n{picture * every}\nITEM: TIME\n{picture * every * O.dt:.9g}\nITEM: NUMBER OF ATOMS\n{count}\n")
        out.write(f"ITEM: BOX BOUNDS pp ff pp\n0 {long}\n0 {high}\n0 {D}\nITEM: ATOMS id type x y vx vy radius\n")
        for k, state in zip(grains, states):
            (x, y, _), (vx, vy, _) = state.pos, state.vel
            out.write(f"{k} 1 {x % long:.6g} {y - D:.6g} {vx:.6g} {vy:.6g} {O.bodies[k].shape.radius:.6g}\n")
        if picture < pictures:
            O.run(every, True)
if not angle:
    with open("walls.txt", "w") as out:
        out.write(f"# step, shear stress, pressure [Pa]\n0 {drag / samples:.6g} {weight / samples:.6g}\n")
for name, asked in (("kn", stiffness), ("ks", 0.5 * stiffness), ("cn", damping)):
    worst = max(abs(getattr(i.phys, name) / asked - 1) for i in O.interactions if i.isReal)
    assert worst < 1e-6, f"{name} of a contact is off by {worst:.3g}"
