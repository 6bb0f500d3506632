"""A square column of water, released at once: the case, or with "tables" its front over time."""
import sys

import numpy as np

import particles

SPACING, BED, WALL, DURATION, EVERY = 0.01, 2.4, 0.75, 0.46, 0.02
given = particles.inputs(sys.argv[1])
width, height, gravity = given["upper x"], given["upper y"], -given["gravity y"]


def write():
    constants = particles.constants(SPACING, 20 * (gravity * height) ** 0.5, given["density without pressure"])
    # cells of the lattice, also below the bed and behind the back wall
    layers = 4
    columns, rows = np.arange(-layers, round(BED / SPACING)), np.arange(-layers, round(WALL / SPACING))
    x, z = (part.ravel() for part in np.meshgrid((columns + 0.5) * SPACING, (rows + 0.5) * SPACING))
    wall = np.column_stack([x, z])[(x < 0) | (z < 0)]
    # each wall particle points to the nearest place of the bed or of the back wall
    normals = np.maximum(0.0, -wall)
    fluid = np.column_stack([x, z])[(x > 0) & (x < width) & (z > 0) & (z < height)]
    below = constants["rhop0"] * gravity * (height - fluid[:, 1])
    parameters = {
        "StepAlgorithm": 2, "Kernel": 2, "ViscoTreatment": 1, "Visco": 0.01, "ViscoBoundFactor": 1,
        "DensityDT": 2, "DensityDTvalue": 0.1, "Boundary": 2, "SlipMode": 3,
        "TimeMax": DURATION, "TimeOut": EVERY,
    }
    settings = constants | {"gravity": (given["gravity x"], -gravity), "parameters": parameters}
    particles.write("case", settings, wall, normals, fluid, 0.0, particles.at_rest(constants, below))


def tables():
    least, bins = width / 50, round(BED / SPACING)
    print("t,front,height")
    for time, x, z, _ in particles.pictures("out"):
        thickness = particles.thickness(x, SPACING, bins)
        k = int(np.argmax(thickness < least))
        part = (thickness[k - 1] - least) / (thickness[k - 1] - thickness[k])
        # half a spacing above the highest particle beside the back wall
        top = np.max(z[x < 0.1 * width]) + SPACING / 2
        print(f"{time:.6g},{(k - 0.5 + part) * SPACING:.6g},{top:.6g}")


tables() if sys.argv[2:] == ["tables"] else write()
