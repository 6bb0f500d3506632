"""Spheres on a slope of 26 degrees by YADE, periodic along and across it, on a bed of glued spheres.

yade -n -x slope.py, in a folder of its own. SI units. At five times the spheres are written by
VTKRecorder (VTU) and by VTKExporter (legacy VTK), the contacts as a table, and YADE's own sums.
"""
import math
import random

from yade import *  # the program offers its classes to a script by this name
from yade import export

diameter, density, gravity, angle = 0.002, 2500.0, 9.81, math.radians(26.0)
long, wide, depth = 6 * diameter, 4 * diameter, 6 * diameter
random.seed(7)

# springs that are a thousand times stiffer than the layer is heavy; restitution about 0.5
stiffness = 1000 * density * 0.6 * gravity * depth * diameter
contact_time = math.pi * math.sqrt(0.5 * density * math.pi * diameter**3 / 6 / stiffness)
damping = 1.386 / contact_time * density * math.pi * diameter**3 / 12
# two bodies in contact are springs in a row, so that each has twice the stiffness of the contact
spring = {"kn": 2 * stiffness, "ks": stiffness, "cn": 2 * damping, "cs": 0.0}
material = O.materials.append(ViscElMat(frictionAngle=math.atan(0.5), density=density, **spring))
O.periodic = True
O.cell.hSize = Matrix3(long, 0, 0, 0, 8 * depth, 0, 0, 0, wide)


def sphere(place, size, fixed):
    """Adds a sphere; `mask` is 3 in the bed and 1 above it."""
    body = utils.sphere(place, 0.5 * size * diameter, fixed=fixed, material=material)
    body.mask = 3 if fixed else 1
    if not fixed:
        body.state.vel = (6 * math.sqrt(gravity * diameter), 0, 0)
    O.bodies.append(body)


for k in range(6 * 4):
    sphere(((k // 4 + 0.5) * diameter, 0.5 * diameter, (k % 4 + 0.5) * diameter), 1.0, True)
# grains of 0.8 to 1.2 diameters on a loose lattice, each moved at random
count = int(long * depth * wide * 0.58 / (math.pi * diameter**3 / 6 * 1.04))
spacing = 1.3 * diameter
along, across = int(long / spacing), int(wide / spacing)
for k in range(count):
    places = (k % along + 0.5) * spacing, (k // along % across + 0.5) * spacing
    x, z = (place + random.uniform(0, 0.1) * diameter for place in places)
    y = 1.8 * diameter + k // (along * across) * spacing
    sphere((x, y, z), 0.8 + 0.4 * ((k * 0.6180339887) % 1), False)

O.dt = contact_time / 20
down = (gravity * math.sin(angle), -gravity * math.cos(angle), 0)
record = VTKRecorder(fileName="slope-", recorders=["spheres", "velocity", "id", "mask"], iterPeriod=1, dead=True)
O.engines = [
    ForceResetter(),
    InsertionSortCollider([Bo1_Sphere_Aabb()], verletDist=0.2 * diameter, allowBiggerThanPeriod=True),
    InteractionLoop(
        [Ig2_Sphere_Sphere_ScGeom()],
        [Ip2_ViscElMat_ViscElMat_ViscElPhys()],
        [Law2_ScGeom_ViscElPhys_Basic()],
    ),
    NewtonIntegrator(damping=0.0, gravity=down),
    record,
]
unit = math.sqrt(diameter / gravity)
O.run(int(100 * unit / O.dt), True)
exporter = export.VTKExporter("exported")
fields = {"velocity": "b.state.vel", "fixed": "1.0 if b.state.blockedDOFs else 0.0"}
with open("sums.csv", "w") as sums:
    sums.write("time [s],mass [kg],momentum [kg m/s],stress_yy [N m],stress_xy [N m]\n")
    for picture in range(5):
        O.run(int(5 * unit / O.dt) - 1, True)
        record.dead = False
        O.run(1, True)
        record.dead = True
        exporter.exportSpheres(what=fields)
        with open(f"contacts-{picture}.csv", "w") as out:
            out.write("first,second,fx [N],fy [N]\n")
            for contact in O.interactions:
                # YADE's force is that on the second body
                force = -(contact.phys.normalForce + contact.phys.shearForce)
                out.write(f"{contact.id1},{contact.id2},{force[0]:.5g},{force[1]:.5g}\n")
        grains = [body.state for body in O.bodies if body.mask == 1]
        momentum = sum(state.mass * state.vel[0] for state in grains)
        stress = utils.getStress(1.0)
        sums.write(f"{O.time:.6g},{sum(state.mass for state in grains):.6g},{momentum:.6g},")
        sums.write(f"{stress[1][1]:.6g},{stress[0][1]:.6g}\n")
