#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Builds a document, makes a second one from it with another value, and writes both as MaterialX: edit.c in Python."""
import mxgen

context = mxgen.Context()
with context.edit(name="copper") as edit:
    noise = edit.add("noise2d", "Spots", "float")
    shader = edit.add("standard_surface", "SR", "surfaceshader")
    shader.value("base_color", (0.93, 0.62, 0.52), "color3").value("metalness", 1, "float")
    shader.connect("specular_roughness", noise)
    edit.add("surfacematerial", "Copper", "material").connect("surfaceshader", shader)
copper = edit.document
print(copper.xml(), end="")

with copper.edit() as edit: # the first document stays as it is
    edit["SR"].value("specular_roughness", 0.1)
    edit["Spots"].remove()
print(edit.document.xml(), end="")
