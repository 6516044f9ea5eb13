# How a diced model looks in Blender 3.4, which brings no light of its own: its vertex colours are all.
#   blender -b -P docs/draw_diced.py -- MODEL.obj PICTURE.png EYE_X EYE_Y EYE_Z TARGET_X TARGET_Y TARGET_Z FOV
import math
import sys

import bpy
from mathutils import Vector

model, picture, *numbers = sys.argv[sys.argv.index("--") + 1:]
place = lambda x, y, z: Vector((x, -z, y))  # Blender is z up
numbers = [float(n) for n in numbers]
eye, target, fov = place(*numbers[0:3]), place(*numbers[3:6]), numbers[6]

bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.wm.obj_import(filepath=model)
material = bpy.data.materials.new("voxel colours")
material.use_nodes = True
nodes, links = material.node_tree.nodes, material.node_tree.links
nodes.clear()
colour, light, out = (nodes.new("ShaderNode" + kind) for kind in ("VertexColor", "Emission", "OutputMaterial"))
links.new(colour.outputs["Color"], light.inputs["Color"])
links.new(light.outputs["Emission"], out.inputs["Surface"])
for thing in bpy.data.objects:
    thing.data.materials.clear()
    thing.data.materials.append(material)

scene = bpy.context.scene
camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
scene.collection.objects.link(camera)
scene.camera = camera
camera.location = eye
camera.rotation_euler = (target - eye).to_track_quat("-Z", "Y").to_euler()
camera.data.sensor_fit = "VERTICAL"
camera.data.angle = math.radians(fov)
scene.world = bpy.data.worlds.new("sky")
scene.world.use_nodes = True
scene.world.node_tree.nodes["Background"].inputs["Color"].default_value = (0.55, 0.66, 0.8, 1)
scene.render.engine = "CYCLES"
scene.cycles.samples, scene.cycles.max_bounces, scene.cycles.use_denoising = 16, 0, False
scene.render.resolution_x, scene.render.resolution_y = 780, 585
scene.view_settings.view_transform = "Standard"
scene.render.filepath = picture
bpy.ops.render.render(write_still=True)
