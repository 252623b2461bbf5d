# SPDX-License-Identifier: Apache-2.0
"""Shared by the tests of the Python package. run.py sets the two places."""
import pathlib

EXAMPLES = pathlib.Path()
PROGRAM = ""

GOLD = """<?xml version="1.0"?>
<materialx version="1.39">
  <standard_surface name="SR" type="surfaceshader">
    <input name="base_color" type="color3" value="0.9, 0.6, 0.2" />
    <input name="metalness" type="float" value="1" />
    <input name="specular_roughness" type="float" nodename="Spots" />
  </standard_surface>
  <noise2d name="Spots" type="float" />
  <surfacematerial name="Gold" type="material">
    <input name="surfaceshader" type="surfaceshader" nodename="SR" />
  </surfacematerial>
</materialx>
"""

BROKEN = """<?xml version="1.0"?>
<materialx version="1.39">
  <standard_surface name="SR" type="surfaceshader">
    <input name="base_color" type="color3" value="red" />
  </standard_surface>
  <surfacematerial name="Gold" type="material">
    <input name="surfaceshader" type="surfaceshader" nodename="SR" />
  </surfacematerial>
</materialx>
"""
