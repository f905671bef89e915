# The scenes of bench/cornell.ray and bench/dragon.ray for Cycles, Blender's path tracer:
#
#   blender --background --factory-startup --python bench/cycles.py -- cornell SAMPLES SEED OUT.exr
#   blender --background --factory-startup --python bench/cycles.py -- dragon SAMPLES SEED OUT.exr MESH.ply
#
# prints the CPU seconds of the process around the render, 256 x 256 pixels. Two threads, no denoising, no adaptive
# sampling, all bounces 8, box filter, no clamps.
import array
import math
import resource
import sys

import bpy
from mathutils import Vector

name, samples, seed, out, *rest = sys.argv[sys.argv.index("--") + 1:]
bpy.ops.wm.read_factory_settings(use_empty=True)
scene = bpy.context.scene


def material(name, kind, **inputs):
    made = bpy.data.materials.new(name)
    made.use_nodes = True
    nodes, links = made.node_tree.nodes, made.node_tree.links
    nodes.clear()
    shader = nodes.new(kind)
    for key, value in inputs.items():
        shader.inputs[key].default_value = value
    if kind == "ShaderNodeBsdfGlass":
        shader.distribution = "SHARP"
    links.new(shader.outputs[0], nodes.new("ShaderNodeOutputMaterial").inputs["Surface"])
    return made


def diffuse(name, *color):
    return material(name, "ShaderNodeBsdfDiffuse", Color=(*color, 1))


def mesh(name, points, faces, look):
    data = bpy.data.meshes.new(name)
    data.from_pydata(points, [], faces)
    data.materials.append(look)
    scene.collection.objects.link(bpy.data.objects.new(name, data))
    return data


def box(name, center, size, degrees, look):
    turn = math.radians(degrees)
    points = []
    for z in (-0.5, 0.5):
        for x, y in ((-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5)):
            x, y = x * size[0], y * size[1]
            points.append((center[0] + x * math.cos(turn) - y * math.sin(turn),
                           center[1] + x * math.sin(turn) + y * math.cos(turn), center[2] + z * size[2]))
    mesh(name, points, [(3, 2, 1, 0), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)], look)


def square(name, half, z, look):
    mesh(name, [(-half, -half, z), (half, -half, z), (half, half, z), (-half, half, z)], [(0, 1, 2, 3)], look)


def ball(name, center, radius, look):
    """Of quadrangles, shaded as if it were smooth."""
    around, down = 256, 128
    points = [(center[0], center[1], center[2] + radius)]
    for row in range(1, down):
        polar = math.pi * row / down
        for column in range(around):
            turn = 2 * math.pi * column / around
            points.append((center[0] + radius * math.sin(polar) * math.cos(turn),
                           center[1] + radius * math.sin(polar) * math.sin(turn), center[2] + radius * math.cos(polar)))
    points.append((center[0], center[1], center[2] - radius))
    at = lambda row, column: 1 + (row - 1) * around + column % around
    faces = [(0, at(1, c), at(1, c + 1)) for c in range(around)]
    for row in range(1, down - 1):
        faces += [(at(row, c), at(row + 1, c), at(row + 1, c + 1), at(row, c + 1)) for c in range(around)]
    faces += [(len(points) - 1, at(down - 1, c + 1), at(down - 1, c)) for c in range(around)]
    for polygon in mesh(name, points, faces, look).polygons:
        polygon.use_smooth = True


def ply(path):
    """Points and triangles of a binary file that has nothing else."""
    data = open(path, "rb").read()
    start = data.index(b"end_header\n") + len(b"end_header\n")
    counts = [int(line.split()[2]) for line in data[:start].decode().splitlines() if line.startswith("element")]
    middle = start + 12 * counts[0]
    floats = array.array("f", data[start:middle])
    corners = array.array("i")
    for n in range(counts[1]):
        corners.frombytes(data[middle + 13 * n + 1:middle + 13 * n + 13])
    return list(zip(*[iter(floats)] * 3)), list(zip(*[iter(corners)] * 3))


def cornell():
    white, red, green = diffuse("white", 0.73, 0.73, 0.73), diffuse("red", 0.63, 0.065, 0.05), diffuse("green", 0.14, 0.45, 0.091)
    mesh("floor", [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)], [(0, 1, 2, 3)], white)
    mesh("ceiling", [(0, 0, 1), (0, 1, 1), (1, 1, 1), (1, 0, 1)], [(0, 1, 2, 3)], white)
    mesh("back", [(0, 1, 0), (1, 1, 0), (1, 1, 1), (0, 1, 1)], [(0, 1, 2, 3)], white)
    mesh("left", [(0, 0, 0), (0, 1, 0), (0, 1, 1), (0, 0, 1)], [(0, 1, 2, 3)], red)
    mesh("right", [(1, 0, 0), (1, 0, 1), (1, 1, 1), (1, 1, 0)], [(0, 1, 2, 3)], green)
    low, high = 0.35, 0.65
    mesh("lamp", [(low, low, 0.999), (low, high, 0.999), (high, high, 0.999), (high, low, 0.999)], [(0, 1, 2, 3)],
         material("lamp", "ShaderNodeEmission", Strength=17))
    box("tall", (0.33, 0.65, 0.3), (0.3, 0.3, 0.6), -17, white)
    box("short", (0.68, 0.32, 0.15), (0.3, 0.3, 0.3), 18, white)
    return (0.5, -1.35, 0.5), (0.5, 0, 0.5), 0


def dragon(path):
    points, faces = ply(path)
    points = [(x, -z, y) for x, y, z in points]  # z is up
    low, high = ([find(p[k] for p in points) for k in range(3)] for find in (min, max))
    size = 2.2 / (high[0] - low[0])
    points = [(-0.35 + size * (x - (low[0] + high[0]) / 2), size * (y - (low[1] + high[1]) / 2), size * (z - low[2]))
              for x, y, z in points]
    mesh("dragon", points, faces, diffuse("brown", 0.6, 0.45, 0.3))
    square("floor", 10, 0, diffuse("grey", 0.6, 0.6, 0.6))
    ball("ball", (1.25, -0.5, 0.45), 0.45, material("glass", "ShaderNodeBsdfGlass", IOR=1.5, Roughness=0))
    square("lamp", 1, 5, material("lamp", "ShaderNodeEmission", Strength=12))
    return (0, -5, 2), (0, 0, 0.6), 0.5


position, target, around = {"cornell": cornell, "dragon": dragon}[name](*rest)
camera = bpy.data.cameras.new("camera")
camera.sensor_fit = "VERTICAL"
camera.angle = math.radians(40)
eye = bpy.data.objects.new("camera", camera)
eye.location = position
eye.rotation_euler = (Vector(target) - Vector(position)).to_track_quat("-Z", "Y").to_euler()
scene.collection.objects.link(eye)
scene.camera = eye
scene.world = bpy.data.worlds.new("around")
scene.world.color = (around, around, around)

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
cycles.caustics_reflective = cycles.caustics_refractive = True
cycles.blur_glossy = 0
cycles.pixel_filter_type = "BOX"
cycles.filter_width = 1

before = resource.getrusage(resource.RUSAGE_SELF)
bpy.ops.render.render(write_still=True)
after = resource.getrusage(resource.RUSAGE_SELF)
print("cpu", after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime)
