# SPDX-License-Identifier: Apache-2.0
"""The library of an OpenColorIO configuration: what mxgen computes with it is what OpenColorIO computes."""
import contextlib
import functools
import io
import itertools
import pathlib
import re
import tempfile
import unittest

import mxgen
from mxgen import ocio as mxgen_ocio

try:
    import PyOpenColorIO
except ImportError:
    PyOpenColorIO = None

CONFIG = """
ocio_profile_version: 2
search_path: .
strictparsing: true
roles: {default: lin_rec709, scene_linear: acescg}
file_rules:
  - !<Rule> {name: Default, colorspace: default}
displays:
  none:
    - !<View> {name: Raw, colorspace: lin_rec709}
colorspaces:
  - !<ColorSpace> {name: lin_rec709}
  - !<ColorSpace>
    name: acescg
    aliases: [lin_ap1]
    to_scene_reference: !<MatrixTransform> {matrix: [1.7, -0.6, -0.1, 0, -0.13, 1.14, -0.01, 0, -0.02, -0.13, 1.15, 0, 0, 0, 0, 1], offset: [0.01, 0, 0, 0]}
  - !<ColorSpace>
    name: "sRGB - Texture"
    aliases: [srgb_studio]
    to_scene_reference: !<ExponentWithLinearTransform> {gamma: 2.4, offset: 0.055}
  - !<ColorSpace>
    name: mirrored
    to_scene_reference: !<ExponentWithLinearTransform> {gamma: [2.2, 2.4, 2.6, 1], offset: 0.09, style: mirror}
  - !<ColorSpace>
    name: g22
    to_scene_reference: !<ExponentTransform> {value: 2.2}
  - !<ColorSpace>
    name: g22_mirror
    to_scene_reference: !<ExponentTransform> {value: [2.2, 1.8, 2, 1], style: mirror}
  - !<ColorSpace>
    name: g22_pass
    from_scene_reference: !<ExponentTransform> {value: [0.5, 0.6, 0.7, 1], style: pass_thru}
  - !<ColorSpace>
    name: camera
    to_scene_reference: !<LogCameraTransform> {base: 10, log_side_slope: 0.25, log_side_offset: 0.39, lin_side_slope: 5.5, lin_side_offset: 0.05, lin_side_break: 0.01, direction: inverse}
  - !<ColorSpace>
    name: affine
    from_scene_reference: !<LogAffineTransform> {base: 2, log_side_slope: 0.18, log_side_offset: 0.5, lin_side_slope: 1.1, lin_side_offset: 0.01}
  - !<ColorSpace>
    name: plain_log
    from_scene_reference: !<LogTransform> {base: 10}
  - !<ColorSpace>
    name: graded
    to_scene_reference: !<CDLTransform> {slope: [1.1, 0.9, 1], offset: [0.02, 0, -0.01], power: [1.2, 1, 0.8], sat: 0.9}
  - !<ColorSpace>
    name: graded_open
    from_scene_reference: !<CDLTransform> {slope: [1.1, 0.9, 1], offset: [0.02, 0, -0.01], power: [1.2, 1, 0.8], sat: 0.9, style: noclamp}
  - !<ColorSpace>
    name: ranged
    to_scene_reference: !<RangeTransform> {min_in_value: 0.1, max_in_value: 0.9, min_out_value: 0, max_out_value: 1}
  - !<ColorSpace>
    name: several
    to_scene_reference: !<GroupTransform> {children: [!<MatrixTransform> {offset: [0.1, 0.1, 0.1, 0]}, !<ExponentTransform> {value: 2}]}
  - !<ColorSpace>
    name: table
    to_scene_reference: !<FileTransform> {src: table.spi1d, interpolation: linear}
  - !<ColorSpace>
    name: falling
    to_scene_reference: !<FileTransform> {src: falling.spi1d, interpolation: linear}
  - !<ColorSpace>
    name: cube
    to_scene_reference: !<FileTransform> {src: cube.spi3d, interpolation: linear}
  - !<ColorSpace>
    name: cube_best
    to_scene_reference: !<FileTransform> {src: cube.spi3d, interpolation: tetrahedral}
  - !<ColorSpace>
    name: cube_large
    to_scene_reference: !<FileTransform> {src: large.spi3d}
  - !<ColorSpace>
    name: "not an identifier"
    to_scene_reference: !<ExponentTransform> {value: 2}
  - !<ColorSpace>
    name: hue
    to_scene_reference: !<FixedFunctionTransform> {style: RGB_TO_HSV}
  - !<ColorSpace> {name: raw, isdata: true}
"""
TABLE = "Version 1\nFrom 0.0 1.0\nLength 5\nComponents 1\n{\n0.0\n0.05\n0.2\n0.5\n1.0\n}\n"
# three channels, with flat parts, falling
FALLING = "Version 1\nFrom 0.0 1.0\nLength 6\nComponents 3\n{\n1 0.9 0.95\n1 0.8 0.9\n0.7 0.8 0.5\n0.7 0.3 0.4\n0.1 0.25 0.2\n0.1 0 0.1\n}\n"


def cube(size):
    """A table of three dimensions that mixes the channels, and is no sum of functions of one."""
    lines = ["SPILUT 1.0", "3 3", f"{size} {size} {size}"]
    for r, g, b in itertools.product(range(size), repeat=3):
        x, y, z = (i / (size - 1) for i in (r, g, b))
        lines.append(f"{r} {g} {b} {x * x * 0.8 + 0.1 * y + 0.05 * x * z:.7f} {y * 0.7 + 0.3 * y * y * x:.7f} {z**1.5 * 0.9 + 0.1 * x * y:.7f}")
    return "\n".join(lines) + "\n"


COLORS = (0.0, 0.18, 1.0), (0.002, 0.5, 0.9), (-0.25, 0.03, 2.5), (0.7, 0.01, 0.4)
DOCUMENT = """<?xml version="1.0"?>
<materialx version="1.39">
  <constant name="c" type="color3"><input name="value" type="color3" value="{value}" colorspace="{space}"/></constant>
  <output name="out" type="color3" nodename="c"/>
</materialx>
"""
MOVING = """<?xml version="1.0"?>
<materialx version="1.39">
  <image name="c" type="color3"><input name="file" type="filename" value="a.png" colorspace="cube"/></image>
  <output name="out" type="color3" nodename="c"/>
</materialx>
"""


@unittest.skipIf(PyOpenColorIO is None, "without PyOpenColorIO (python3-pyopencolorio) there are no configurations")
class ColorSpaces(unittest.TestCase):
    def setUp(self):
        # pylint: disable=consider-using-with  # it lives as long as the test
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        for name, text in ("table.spi1d", TABLE), ("falling.spi1d", FALLING), ("cube.spi3d", cube(9)), ("large.spi3d", cube(34)):
            (self.folder / name).write_text(text, encoding="utf-8")
        self.path = self.folder / "config.ocio"
        self.path.write_text(CONFIG, encoding="utf-8")
        self.config = PyOpenColorIO.Config.CreateFromFile(str(self.path))

    def run_command(self, *arguments):
        out, err = io.StringIO(), io.StringIO()
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
            code = mxgen_ocio.main([str(argument) for argument in arguments])
        return code, out.getvalue(), err.getvalue()

    def value(self, context, library, color, space, working):
        """What the shader computes: the reduced shader of a constant has nothing but its numbers."""
        document = context.parse(DOCUMENT.format(value=", ".join(map(str, color)), space=space), library=library)
        shader = document.generate("glsl", element="out", options={"interface": "reduced", "colorspace": working})
        self.assertEqual(list(shader.diagnostics), [])
        numbers = re.search(r"out1 = vec4\((.*)\);", shader.pixel)
        self.assertIsNotNone(numbers, shader.pixel)
        numbers = [float(number) for number in re.findall(r"-?[0-9.]+(?:e-?[0-9]+)?", numbers.group(1).replace("vec3(", ""))]
        return numbers[:-1] * (3 if len(numbers) == 2 else 1)

    @functools.lru_cache(maxsize=1)
    def studio(self):
        self.assertEqual(self.run_command(self.path, "-o", self.folder / "studio.mtlx")[0], 0)
        context = mxgen.Context()
        return context, context.load_library(self.folder / "studio.mtlx")

    def compare(self, space, working, delta=2e-4):
        context, library = self.studio()
        names = {space.getName(): space.getName() for space in self.config.getColorSpaces()}
        names["srgb_studio"] = "sRGB - Texture"
        processor = self.config.getProcessor(names[space], names[working]).getOptimizedCPUProcessor(PyOpenColorIO.OPTIMIZATION_LOSSLESS)
        for color in COLORS:
            expected, got = processor.applyRGB(list(color)), self.value(context, library, color, space, working)
            for a, b in zip(got, expected):
                self.assertAlmostEqual(a, b, delta=delta * max(1, abs(b)), msg=f"{space} to {working}: {color}: {got}, not {expected}")

    def test_values(self):
        library = mxgen_ocio.make_library(self.config, "studio.glsl")
        spaces = set(library.spaces) - {"lin_ap1"}
        self.assertEqual(len(spaces), 17)
        for space in sorted(spaces):
            with self.subTest(space):
                self.compare(space, "lin_rec709")

    def test_working_spaces(self):
        self.compare("camera", "acescg")
        for space in "g22", "mirrored", "affine", "graded_open", "several", "g22_pass", "plain_log", "ranged", "table", "falling":
            with self.subTest(space):
                self.compare("lin_rec709", space)

    def test_inverse_of_three_dimensions(self):
        # a table stands for the inverse, here as in OpenColorIO's fast way, with another number of entries
        for space in "cube", "cube_best":
            with self.subTest(space):
                self.compare("lin_rec709", space, delta=0.02)

    def test_targets(self):
        """Tables as arrays in every raster language."""
        context, library = self.studio()
        document = context.parse(MOVING, library=library)
        for target in "glsl", "vulkan", "essl", "hlsl":
            shader = document.generate(target, element="out")
            self.assertEqual(list(shader.diagnostics), [])
            self.assertIn("[729]", shader.pixel)

    def test_missing(self):
        code, out, err = self.run_command(self.path, "-o", self.folder / "studio.mtlx")
        self.assertEqual(code, 0)
        self.assertIn("18 names of colour spaces, 3 colour spaces missing", out)
        self.assertIn("'not an identifier' is not in the library: no name or alias of it is an identifier", err)
        self.assertIn("'hue' is not in the library: it needs a FixedFunctionTransform", err)
        self.assertIn("'cube_large' is not in the library: it needs a table (Lut3DTransform) of 34 entries in each direction; 2 to 33", err)

    def test_errors(self):
        self.assertEqual(self.run_command(self.folder / "absent.ocio", "-o", self.folder / "a.mtlx")[0], 1)
        self.assertEqual(self.run_command(self.path, "-o", self.folder / "a.txt")[0], 2)
        self.assertEqual(self.run_command(self.path, "-o", self.folder / "absent/a.mtlx")[0], 1)
        code, _, err = self.run_command(self.path, "-o", self.folder / "a.mtlx", "--hub", "moon")
        self.assertEqual(code, 1)
        self.assertIn("'moon' is no colour space of the configuration; say the name of linear Rec. 709 (--hub)", err)
