"""A laminar film, from its exact profile: the case, or with "tables" its profile and its mean."""
import sys

import numpy as np

import particles

rows = int(sys.argv[2])
COLUMNS, LAYERS, SOUND_SPEED, SURFACE_VELOCITY = 12, 4, 10.0, 0.5
given = particles.inputs(sys.argv[1])
depth, drive, gravity = given["upper y"], given["gravity x"], -given["gravity y"]
spacing = depth / rows
viscosity = drive * depth**2 / (2 * SURFACE_VELOCITY)
# the longest relaxation time of the film; the profile is a mean over the last of two
relaxation = 4 * depth**2 / (np.pi**2 * viscosity)


def write():
    constants = particles.constants(spacing, SOUND_SPEED, given["density"])
    # cells of the lattice, also below the bed
    columns, heights = np.arange(COLUMNS), np.arange(-LAYERS, rows)
    x, z = (part.ravel() for part in np.meshgrid((columns + 0.5) * spacing, (heights + 0.5) * spacing))
    wall, fluid = np.column_stack([x, z])[z < 0], np.column_stack([x, z])[z > 0]
    normals = np.maximum(0.0, -wall) * (0.0, 1.0)
    velocity = drive / viscosity * (depth * fluid[:, 1] - fluid[:, 1] ** 2 / 2)
    below = constants["rhop0"] * gravity * (depth - fluid[:, 1])
    parameters = {
        "StepAlgorithm": 2, "Kernel": 2, "ViscoTreatment": 3, "Visco": viscosity, "ViscoBoundFactor": 1,
        "DensityDT": 2, "DensityDTvalue": 0.1, "Boundary": 2, "SlipMode": 2, "XPeriodicIncZ": 0,
        "TimeMax": 2 * relaxation, "TimeOut": relaxation / 40,
    }
    settings = constants | {"gravity": (drive, -gravity), "parameters": parameters}
    particles.write("case", settings, wall, normals, fluid, velocity, particles.at_rest(constants, below))


def tables():
    count, heights, velocities = np.zeros(rows), np.zeros(rows), np.zeros(rows)
    with open(f"mean-{rows}.csv", "w") as out:
        out.write("t,u\n")
        for time, _, z, velocity in particles.pictures("out"):
            out.write(f"{time:.6g},{velocity.mean():.6g}\n")
            if time > 0.999 * relaxation:
                # means over the rows of the lattice
                row = np.clip((z / spacing).astype(int), 0, rows - 1)
                count += np.bincount(row, minlength=rows)
                heights += np.bincount(row, z, rows)
                velocities += np.bincount(row, velocity, rows)
    with open(f"profile-{rows}.csv", "w") as out:
        out.write("y,u\n")
        for height, velocity in zip(heights / count, velocities / count):
            out.write(f"{height:.6g},{velocity:.6g}\n")


tables() if sys.argv[3:] == ["tables"] else write()
