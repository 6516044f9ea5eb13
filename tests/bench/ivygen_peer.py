# Run by the benchmark inside Blender: grows the add-on's ivy on a wall and prints "IVY nodes CPU-seconds".
import time
from random import seed

import add_curve_ivygen as ivygen
import bmesh
import bpy
from mathutils import Matrix, Vector

WANTED = 50_000
wall = bpy.data.meshes.new("wall")
shape = bmesh.new()
bmesh.ops.create_grid(shape, x_segments=100, y_segments=50, size=0.5)
bmesh.ops.scale(shape, vec=(10, 5, 1), verts=shape.verts)
bmesh.ops.rotate(shape, cent=(0, 0, 0), matrix=Matrix(((1, 0, 0), (0, 0, -1), (0, 1, 0))), verts=shape.verts)
shape.to_mesh(wall)
thing = bpy.data.objects.new("wall", wall)
bpy.context.collection.objects.link(thing)
bpy.context.view_layer.objects.active = thing
bpy.context.view_layer.update()
tree = ivygen.bvhtree_from_object(thing)

nodes, spent, run = 0, 0.0, 0
while nodes < WANTED and run < 1000:
    seed(run)
    ivy = ivygen.Ivy(ivySize=0.048, branchingProbability=0.2)
    ivy.seed(Vector((0.0, -0.02, -2.4)))
    began = time.process_time()
    for _ in range(200):
        ivy.grow(thing, tree)
    spent += time.process_time() - began
    nodes += sum(len(root.ivyNodes) for root in ivy.ivyRoots)
    run += 1
print(f"\nIVY {nodes} {spent}")
