"""Half a planar column of discs against a smooth plane at x = 0, on a bed of glued discs.

Environment: ASPECT aspect ratio, WIDTH half width over the mean diameter, SEED, STEPS in a contact.
SI units. Discs are spheres that stay in a plane, with the mass and the inertia of discs of 1 m.
"""
import math
import os
import random

from yade import *  # the program offers its classes to a script by this name

aspect, width = float(os.environ["ASPECT"]), float(os.environ["WIDTH"])
random.seed(int(os.environ["SEED"]))
half_width, density, gravity = 0.1, 2500.0, 9.81
diameter = half_width / width
height = aspect * half_width
unit = math.sqrt(height / gravity)

# springs that are a thousand times stiffer than the column is heavy; restitution about 0.5
stiffness = 1000 * density * 0.8 * gravity * height
mass = density * math.pi * diameter**2 / 4
contact_time = math.pi * math.sqrt(0.5 * mass / stiffness)
damping = 1.386 / contact_time * 0.5 * mass
# two bodies in contact are springs in a row, so that each has twice the stiffness of the contact
spring = {"kn": 2 * stiffness, "ks": stiffness, "cn": 2 * damping, "cs": 0.0}
grain = O.materials.append(ViscElMat(frictionAngle=math.atan(0.5), density=density, **spring))
smooth = O.materials.append(ViscElMat(frictionAngle=0.0, density=density, **spring))


def disc(x, y, radius, fixed):
    body = utils.sphere((x, y, 0), radius, fixed=fixed, material=grain)
    body.state.mass = density * math.pi * radius**2
    body.state.inertia = Vector3(1, 1, 1) * 0.5 * body.state.mass * radius**2
    if not fixed:
        body.state.blockedDOFs = "zXY"
    return body


# bed: one disc of the mean diameter a diameter
long = (1.5 + 3.4 * aspect) * half_width
for k in range(int(long / diameter)):
    O.bodies.append(disc((k + 0.5) * diameter, -0.5 * diameter, 0.5 * diameter, True))
# no friction at the plane and at the gate
O.bodies.append(utils.wall(0.0, axis=0, sense=1, material=smooth))
gate = O.bodies.append(utils.wall(half_width, axis=0, sense=-1, material=smooth))

# grains of 0.8 to 1.2 diameters on a loose lattice, each moved at random
count = int(1.08 * half_width * height * 0.81 / (math.pi * diameter**2 / 4 * 1.0133))
spacing = 1.3 * diameter
columns = int((half_width - 1.2 * diameter) / spacing) + 1
sizes = [0.8 + 0.4 * ((k * 0.6180339887) % 1) for k in range(count)]
random.shuffle(sizes)
for k, size in enumerate(sizes):
    x, y = (0.6 * diameter + place * spacing for place in (k % columns, k // columns))
    x, y = (place + random.uniform(0.0, 0.05) * diameter for place in (x, y))
    O.bodies.append(disc(x, y, 0.5 * size * diameter, False))

O.dt = contact_time / float(os.environ["STEPS"])
move = NewtonIntegrator(damping=0.2, gravity=(0, -gravity, 0))
O.engines = [
    ForceResetter(),
    InsertionSortCollider([Bo1_Sphere_Aabb(), Bo1_Wall_Aabb()], verletDist=0.15 * diameter),
    InteractionLoop(
        [Ig2_Sphere_Sphere_ScGeom(), Ig2_Wall_Sphere_ScGeom()],
        [Ip2_ViscElMat_ViscElMat_ViscElPhys()],
        [Law2_ScGeom_ViscElPhys_Basic()],
    ),
    move,
]


def grains():
    return [body for body in O.bodies if body is not None and body.state.blockedDOFs == "zXY"]


# settle, then cut flat at h_0
O.run(int(8 * unit / O.dt), True)
move.damping = 0.0
O.run(int(2 * unit / O.dt), True)
for body in grains():
    if body.state.pos[1] > height:
        O.bodies.erase(body.id)
for name, asked in (("kn", stiffness), ("ks", 0.5 * stiffness), ("cn", damping)):
    worst = max(abs(getattr(i.phys, name) / asked - 1) for i in O.interactions if i.isReal)
    assert worst < 1e-6, f"{name} of a contact is off by {worst:.3g}"

# release; a picture every quarter of sqrt(h_0/g), in the layout that tables.py reads
O.bodies.erase(gate)
every = int(0.25 * unit / O.dt)
for picture in range(33):
    with open(f"grains.{picture}.txt", "w") as out:
        out.write(f"ITEM: TIMESTEP\n{picture * every * O.dt:.9g}\nITEM: ATOMS x radius mass\n")
        for body in grains():
            out.write(f"{body.state.pos[0]:.6g} {body.shape.radius:.6g} {body.state.mass:.6g}\n")
    if picture < 32:
        O.run(every, True)
