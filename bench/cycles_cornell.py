# The scene of bench/cornell.ray for Cycles, Blender's path tracer:
#
#   blender --background --factory-startup --python bench/cycles_cornell.py -- SAMPLES SEED OUT.exr
#
# prints the CPU seconds of the process around the render. Two threads, no denoising, no adaptive sampling, all
# bounces 8, box filter, no clamps.
import math
import resource
import sys

import bpy

samples, seed, out = sys.argv[sys.argv.index("--") + 1:]
bpy.ops.wm.read_factory_settings(use_empty=True)
scene = bpy.context.scene


def material(name, color=None, emission=None):
    made = bpy.data.materials.new(name)
    made.use_nodes = True
    nodes, links = made.node_tree.nodes, made.node_tree.links
    nodes.clear()
    output = nodes.new("ShaderNodeOutputMaterial")
    if emission is None:
        shader = nodes.new("ShaderNodeBsdfDiffuse")
        shader.inputs["Color"].default_value = (*color, 1)
    else:
        shader = nodes.new("ShaderNodeEmission")
        shader.inputs["Strength"].default_value = emission
    links.new(shader.outputs[0], output.inputs["Surface"])
    return made


def mesh(name, points, faces, look):
    data = bpy.data.meshes.new(name)
    data.from_pydata(points, [], faces)
    data.materials.append(look)
    scene.collection.objects.link(bpy.data.objects.new(name, data))


def box(name, center, size, degrees, look):
    turn = math.radians(degrees)
    points = []
    for z in (-0.5, 0.5):
        for x, y in ((-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5)):
            x, y = x * size[0], y * size[1]
            points.append((center[0] + x * math.cos(turn) - y * math.sin(turn),
                           center[1] + x * math.sin(turn) + y * math.cos(turn), center[2] + z * size[2]))
    mesh(name, points, [(3, 2, 1, 0), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)], look)


white, red, green = (material(n, c) for n, c in (("white", (0.73,) * 3), ("red", (0.63, 0.065, 0.05)),
                                                 ("green", (0.14, 0.45, 0.091))))
mesh("floor", [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)], [(0, 1, 2, 3)], white)
mesh("ceiling", [(0, 0, 1), (0, 1, 1), (1, 1, 1), (1, 0, 1)], [(0, 1, 2, 3)], white)
mesh("back", [(0, 1, 0), (1, 1, 0), (1, 1, 1), (0, 1, 1)], [(0, 1, 2, 3)], white)
mesh("left", [(0, 0, 0), (0, 1, 0), (0, 1, 1), (0, 0, 1)], [(0, 1, 2, 3)], red)
mesh("right", [(1, 0, 0), (1, 0, 1), (1, 1, 1), (1, 1, 0)], [(0, 1, 2, 3)], green)
low, high = 0.35, 0.65
mesh("lamp", [(low, low, 0.999), (low, high, 0.999), (high, high, 0.999), (high, low, 0.999)], [(0, 1, 2, 3)],
     material("lamp", emission=17))
box("tall", (0.33, 0.65, 0.3), (0.3, 0.3, 0.6), -17, white)
box("short", (0.68, 0.32, 0.15), (0.3, 0.3, 0.3), 18, white)

camera = bpy.data.cameras.new("camera")
camera.sensor_fit = "VERTICAL"
camera.angle = math.radians(40)
eye = bpy.data.objects.new("camera", camera)
eye.location = (0.5, -1.35, 0.5)
eye.rotation_euler = (math.pi / 2, 0, 0)
scene.collection.objects.link(eye)
scene.camera = eye
scene.world = bpy.data.worlds.new("black")
scene.world.color = (0, 0, 0)

render, cycles = scene.render, scene.cycles
render.engine = "CYCLES"
render.resolution_x = render.resolution_y = 256
render.resolution_percentage = 100
render.threads_mode, render.threads = "FIXED", 2
render.image_settings.file_format = "OPEN_EXR"
render.image_settings.color_depth = "32"
render.image_settings.exr_codec = "NONE"
render.filepath = out
scene.view_settings.view_transform = "Raw"
cycles.device = "CPU"
cycles.samples = int(samples)
cycles.seed = int(seed)
cycles.use_adaptive_sampling = cycles.use_denoising = False
cycles.max_bounces = cycles.diffuse_bounces = cycles.glossy_bounces = cycles.transmission_bounces = 8
cycles.sample_clamp_direct = cycles.sample_clamp_indirect = 0
cycles.pixel_filter_type = "BOX"
cycles.filter_width = 1

before = resource.getrusage(resource.RUSAGE_SELF)
bpy.ops.render.render(write_still=True)
after = resource.getrusage(resource.RUSAGE_SELF)
print("cpu", after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime)
