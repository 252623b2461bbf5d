# SPDX-License-Identifier: Apache-2.0
"""The same materials by Cycles and by `mxgen render`: a ball under a sky that is brighter above, both path traced. Lists the mean of each
channel side by side (docs/blender.md)."""
import math
import pathlib
import subprocess

import bpy

SIZE = 48
SAMPLES = 64


def write_sky(path):
    """A map that depends on the elevation alone, so that the programs need not agree on its azimuth."""
    rows, columns = 64, 128
    data = bytearray(f"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {rows} +X {columns}\n".encode())
    for row in range(rows): # from above
        up = max(0, 1 - 2 * (row + 0.5) / rows)
        colour = [0.3 + 1.2 * up * up * tint for tint in (0.8, 0.9, 1)]
        exponent = math.frexp(max(colour))[1]
        data += bytes([*(int(part * 256 / 2 ** exponent) for part in colour), exponent + 128]) * columns
    pathlib.Path(path).write_bytes(data)
    return bpy.data.images.load(str(path))


def build_scene(sky):
    scene = bpy.context.scene
    for one in list(scene.objects):
        bpy.data.objects.remove(one)
    world = bpy.data.worlds.new("sky")
    world.use_nodes = True
    texture = world.node_tree.nodes.new("ShaderNodeTexEnvironment")
    texture.image = sky
    world.node_tree.links.new(texture.outputs["Color"], world.node_tree.nodes["Background"].inputs["Color"])
    scene.world = world
    bpy.ops.mesh.primitive_uv_sphere_add(segments=128, ring_count=64, radius=1)
    bpy.ops.object.shade_smooth()
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    camera.location = (0, -5, 0)
    camera.rotation_euler = (math.pi / 2, 0, 0)
    camera.data.angle = math.radians(30)
    scene.collection.objects.link(camera)
    scene.camera = camera
    render = scene.render
    render.engine, render.film_transparent = "CYCLES", True
    render.resolution_x = render.resolution_y = SIZE
    render.image_settings.file_format, render.image_settings.color_mode = "OPEN_EXR", "RGBA"
    scene.cycles.device, scene.cycles.samples, scene.cycles.use_denoising = "CPU", SAMPLES, False
    scene.cycles.max_bounces = 16
    return bpy.context.object


def mean_of(path):
    """The mean of the pixels inside of the ball. Alpha is that of the film, not of the material."""
    image = bpy.data.images.load(str(path))
    pixels = image.pixels[:]
    # The ball covers asin(1 / 5) of 15 degrees, half of the field of view.
    radius = math.tan(math.asin(1 / 5)) / math.tan(math.radians(15)) * SIZE / 2 - 1
    middle = (SIZE - 1) / 2
    inside = [4 * (row * SIZE + column) for row in range(SIZE) for column in range(SIZE)
              if (row - middle) ** 2 + (column - middle) ** 2 < radius ** 2]
    bpy.data.images.remove(image)
    return [sum(pixels[at + channel] for at in inside) / len(inside) for channel in range(3)]


def by_cycles(ball, material, path):
    ball.data.materials.clear()
    ball.data.materials.append(material)
    bpy.context.scene.render.filepath = str(path)
    bpy.ops.render.render(write_still=True)
    return mean_of(path)


def by_mxgen(program, document, sky, path):
    subprocess.run([program, "render", document, "-o", path, "-m", "sphere", "--size", str(SIZE), "--camera", "0,0,5,30", "--environment", sky,
                    "--path-trace", "--paths", str(SAMPLES), "-q"], check=True)
    return mean_of(path)
