"""Half a planar pile of bars by Newton's implicit material points; writes pictures.npz.

The pile is that of Bui et al. (2008). Its friction does not depend on the rate. Newton computes
in three dimensions: x along the bed, y across, z upwards. A slice between two smooth walls stands
for the plane. SI units.
"""
import math

import newton
import numpy as np
import warp as wp
from newton.solvers import SolverImplicitMPM

half_width, height = 0.2, 0.1
gravity = 9.81
friction = 0.360022
density = 0.8 * 2650.0  # in bulk: solid fraction times density of a bar

voxel = 0.01
spacing = voxel / 2
slice_width = 2 * voxel
free_fall_time = math.sqrt(height / gravity)
steps_per_picture = 6
time_step = free_fall_time / 24  # so a picture follows every quarter of the free-fall time
pictures = 60  # the case simulates at most 15 free-fall times

wp.config.quiet = True
wp.set_device("cpu")

builder = newton.ModelBuilder()
SolverImplicitMPM.register_custom_attributes(builder)
columns, layers, rows = (round(size / spacing) for size in (half_width, slice_width, height))
builder.add_particle_grid(
    pos=wp.vec3(spacing / 2, spacing / 2, spacing / 2),
    rot=wp.quat_identity(),
    vel=wp.vec3(0.0),
    dim_x=columns,
    dim_y=layers,
    dim_z=rows,
    cell_x=spacing,
    cell_y=spacing,
    cell_z=spacing,
    mass=density * spacing**3,
    jitter=0.0,
    radius_mean=spacing / 2,
)

# A friction of 100 lets nothing slide on the bed. The symmetry plane and both sides are smooth.
builder.add_ground_plane(cfg=newton.ModelBuilder.ShapeConfig(mu=100.0))
walls = (  # centre and half sizes
    ((-0.1, slice_width / 2, 0.2), (0.1, 0.5, 0.5)),
    ((0.5, -0.1, 0.2), (1.0, 0.1, 0.5)),
    ((0.5, slice_width + 0.1, 0.2), (1.0, 0.1, 0.5)),
)
for centre, half_size in walls:
    builder.add_shape_box(
        body=-1,
        cfg=newton.ModelBuilder.ShapeConfig(mu=0.0, density=0.0),
        xform=wp.transform(wp.vec3(*centre), wp.quat_identity()),
        hx=half_size[0],
        hy=half_size[1],
        hz=half_size[2],
    )
model = builder.finalize()
model.set_gravity((0.0, 0.0, -gravity))

# Newton's yield surface is sqrt(s:s/2) = friction p, as in the case. Grains below it are rigid
# here: so stiff a material has no elastic strain. It bears no tension and does not dilate.
model.mpm.friction.fill_(friction)
model.mpm.young_modulus.fill_(1e15)
model.mpm.yield_pressure.fill_(1e12)
model.mpm.tensile_yield_ratio.fill_(0.0)
model.mpm.yield_stress.fill_(0.0)

config = SolverImplicitMPM.Config()
config.voxel_size = voxel
config.air_drag = 0.0
config.tolerance = 1e-5
config.max_iterations = 250
solver = SolverImplicitMPM(model, config=config)

now, later = model.state(), model.state()
places, velocities = [now.particle_q.numpy().copy()], [now.particle_qd.numpy().copy()]
for _ in range(pictures):
    for _ in range(steps_per_picture):
        solver.step(now, later, None, None, time_step)
        solver.project_outside(later, later, time_step)
        now, later = later, now
    places.append(now.particle_q.numpy().copy())
    velocities.append(now.particle_qd.numpy().copy())
    print(f"picture {len(places) - 1} of {pictures}", flush=True)

np.savez(
    "pictures.npz",
    times=np.arange(pictures + 1) * steps_per_picture * time_step,
    places=np.array(places),
    velocities=np.array(velocities),
    area=half_width * height / (columns * layers * rows),
    spacing=spacing,
    half_width=half_width,
    height=height,
    gravity=gravity,
)
