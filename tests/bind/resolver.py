# SPDX-License-Identifier: Apache-2.0
"""The layers of each primitive, computed slowly and in the plainest way from the rules of docs/slots.md: for each primitive, each name
and each assignment by itself. It shares nothing with src/bind but the rules. `resolve` gives what `mxgen bind --json` writes, without
places in files and names of stacks."""
import re
import xml.etree.ElementTree as ElementTree

PRODUCTS = ["surfaceshader", "backsurfaceshader", "displacementshader", "normal", "mask"]
NAME = re.compile(r"(\w+)(?:\|(\w+))?(?:::(\w+))?$", re.ASCII)


# ---- Paths ----

def levels_of(path):
    return [name for name in path.split("/") if name]


def ancestors(path):
    """The path, the paths above it, and "/" last."""
    names = levels_of(path)
    return ["/" + "/".join(names[:length]) for length in range(len(names), -1, -1)]


def split(text, separator):
    """Parts of a text; a separator in brackets separates nothing."""
    parts, depth, in_set = [""], 0, False
    for char in text:
        if in_set:
            in_set = char != "]"
        elif char == "[":
            in_set = True
        else:
            depth += (char == "{") - (char == "}")
        if char == separator and not depth and not in_set:
            parts.append("")
        else:
            parts[-1] += char
    return parts


def alternatives(glob):
    """A glob without braces for each choice of its alternatives."""
    in_set = False
    for begin, char in enumerate(glob):
        if in_set:
            in_set = char != "]"
        elif char == "[":
            in_set = True
        elif char == "{":
            depth, end = 0, begin
            while True:
                depth += (glob[end] == "{") - (glob[end] == "}")
                if not depth:
                    break
                end += 1
            inner = [part.strip(" ") for part in split(glob[begin + 1:end], ",")]
            return [whole for part in inner for whole in alternatives(glob[:begin] + part + glob[end + 1:])]
    return [glob]


def name_matches(glob, name):
    """One name against one glob without braces."""
    if not glob:
        return not name
    if glob[0] == "*":
        return any(name_matches(glob[1:], name[skip:]) for skip in range(len(name) + 1))
    if not name:
        return False
    if glob[0] == "[":
        end = glob.index("]")
        inner, found, at = glob[1:end], False, 0
        while at < len(inner):
            if inner[at + 1:at + 2] == "-" and at + 2 < len(inner):
                found |= inner[at] <= name[0] <= inner[at + 2]
                at += 3
            else:
                found |= inner[at] == name[0]
                at += 1
        return found and name_matches(glob[end + 1:], name[1:])
    return (glob[0] == "?" or glob[0] == name[0]) and name_matches(glob[1:], name[1:])


def levels_match(globs, names):
    """Globs of levels, "//" among them, against the names of a path."""
    if not globs:
        return not names
    if globs[0] == "//":
        return any(levels_match(globs[1:], names[skip:]) for skip in range(len(names) + 1))
    return bool(names) and any(name_matches(glob, names[0]) for glob in alternatives(globs[0])) and levels_match(globs[1:], names[1:])


def pattern_matches(pattern, path, is_leaf):
    if pattern.endswith("//*") and not is_leaf:
        return False
    globs = []
    for number, level in enumerate(split(pattern, "/")):
        if level:
            globs.append(level)
        elif number and globs[-1:] != ["//"]:
            globs.append("//")
    # One '/' at the end says nothing, and one at the begin is no empty level.
    slashes = len(pattern) - len(pattern.rstrip("/"))
    if globs and globs[-1] == "//" and slashes == 1:
        globs.pop()
    return levels_match(globs, levels_of(path))


# ---- The document ----

class Look:
    def __init__(self, text):
        self.root = ElementTree.fromstring(text)
        self.top = {}
        self.parents = {child: parent for parent in self.root.iter() for child in parent}
        for element in self.root:
            self.top[element.get("name")] = element

    def prefix(self, element):
        while element is not None:
            if "geomprefix" in element.attrib:
                return element.get("geomprefix")
            element = self.parents.get(element)
        return ""

    def geometry(self, element, attribute):
        text = element.get(attribute, "")
        return [self.prefix(element) + part.strip() for part in split(text, ",") if part.strip()] if text else []

    def choose(self, name):
        if name is None:
            name = next(element.get("name") for element in self.root if element.tag == "look")
        while self.top[name].tag == "lookgroup":
            name = self.top[name].get("default")
        return name

    def chain(self, name):
        """A look and its parents, the look first."""
        chain = []
        while name:
            chain.append(self.top[name])
            name = self.top[name].get("inherit")
        return chain


class Assign:
    def __init__(self, look, element, generation, order):
        self.element, self.generation, self.order = element, generation, order
        self.name = element.get("slot", "000")
        self.target = element.get("material") or element.get("nodegraph") or ""
        self.is_graph = bool(element.get("nodegraph"))
        self.is_shared = element.get("exclusive") == "false"
        self.collection = element.get("collection")
        self.patterns = look.geometry(element, "geom")
        self.label = f"{look.parents[element].get('name')}/{element.get('name')}"
        material = look.top.get(self.target)
        self.kind = "layer"
        if material is not None and "::" not in self.name:
            self.kind = {"volumematerial": "volume", "lightmaterial": "light"}.get(material.tag, "layer")
        self.variants = element.findall("variantassign")
        # the categories of the nodes that the material is made of
        self.nodes = {look.top[child.get("nodename")].tag for child in (material if material is not None else []) if child.get("nodename") in look.top}
        self.products = [child.get("name") for child in (material if material is not None else []) if child.get("name") in PRODUCTS]


# ---- The rules ----

class Resolver:
    def __init__(self, text, paths, look_name=None):
        self.look = Look(text)
        self.paths = []
        for path in paths:
            for above in reversed(ancestors(path)[:-1]):
                if above not in self.paths:
                    self.paths.append(above)
        inner = {ancestors(path)[1] for path in self.paths}
        self.leaves = {path for path in self.paths if path not in inner}
        chain = self.look.chain(self.look.choose(look_name))
        self.assigns = []
        for generation, look in enumerate(reversed(chain)):
            for element in look:
                if element.tag == "materialassign":
                    self.assigns.append(Assign(self.look, element, generation, len(self.assigns)))
        self.variants = [element for look in reversed(chain) for element in look if element.tag == "variantassign"]
        order = next((look.get("slotorder") for look in chain if "slotorder" in look.attrib), "")
        self.order = [part.strip() for part in order.split(",")] if order else []

    # Where things stand: the path, or None.

    def deepest(self, patterns, path):
        return next((above for above in ancestors(path)
                     if any(pattern_matches(pattern, above, above in self.leaves) for pattern in patterns)), None)

    def held_at(self, collection, path):
        element = self.look.top[collection]
        if self.deepest(self.look.geometry(element, "excludegeom"), path) is not None:
            return None
        places = [self.deepest(self.look.geometry(element, "includegeom"), path)]
        places += [self.held_at(nested.strip(), path) for nested in element.get("includecollection", "").split(",") if nested.strip()]
        places = [place for place in places if place is not None]
        return max(places, key=lambda place: len(levels_of(place))) if places else None

    def stands_at(self, assign, path):
        return self.held_at(assign.collection, path) if assign.collection else self.deepest(assign.patterns, path)

    def includes(self, outer, inner):
        nested = [name.strip() for name in self.look.top[outer].get("includecollection", "").split(",") if name.strip()]
        return any(name == inner or self.includes(name, inner) for name in nested)

    def ranked(self, name, path):
        """The assignments of a name that reach a path, the strongest first, with their places."""
        rest = [(assign, self.stands_at(assign, path)) for assign in self.assigns if assign.name == name]
        rest = [(assign, place) for assign, place in rest if place is not None]
        ranked = []
        while rest:
            deepest = max(len(levels_of(place)) for _, place in rest)
            here = [one for one in rest if len(levels_of(one[1])) == deepest]
            first = [one for one in here
                     if not any(one[0].collection and other[0].collection and self.includes(one[0].collection, other[0].collection)
                                for other in here if other is not one)]
            best = max(first, key=lambda one: (one[0].generation, one[0].order))
            ranked.append(best)
            rest.remove(best)
        return ranked

    # Names in order.

    def part_key(self, part):
        if not part:
            return (0, 0, b"")
        return (1, self.order.index(part) if part in self.order else len(self.order), part.encode())

    def name_key(self, name):
        slot, vertical, override = NAME.match(name).groups()
        return self.part_key(slot), self.part_key(vertical), self.part_key(override)

    # Layers.

    @staticmethod
    def source(assign, place, path):
        return {"nodegraph" if assign.is_graph else "material": assign.target, "from": place, "inherited": place != path,
                "assign": assign.label}

    def chain_of(self, name, path):
        """The strongest assignment of a name, and those whose products complete it."""
        chain = []
        for assign, place in self.ranked(name, path):
            if not assign.target:
                break
            chain.append((assign, place))
            if not assign.is_shared:
                break
        return chain

    def applies(self, variant, assign):
        node = self.look.top[variant.get("variantset")].get("node")
        return node is None or node in assign.nodes

    def variants_of(self, assign):
        """What a layer says of the variants that apply to its material, those of the looks first; of a set the last one alone."""
        picked = [(variant.get("variantset"), variant.get("variant")) for variant in self.variants + assign.variants if self.applies(variant, assign)]
        variants = [{"variantset": name, "variant": variant} for i, (name, variant) in enumerate(picked) if name not in [later for later, _ in picked[i + 1:]]]
        return {"variants": variants} if variants else {}

    def layer(self, name, names, path):
        """The layer of a name without override, with its overrides; None if there is none."""
        chain = self.chain_of(name, path)
        layers = [one for one in chain if one[0].kind == "layer"]
        if not layers:
            return None
        layer = {"slot": name, **self.source(*layers[0], path)}
        had, products = set(layers[0][0].products), {}
        for assign, place in layers[1:]:
            for product in assign.products:
                if product not in had:
                    had.add(product)
                    products[product] = self.source(assign, place, path)
        if products:
            layer["products"] = products
        layer.update(self.variants_of(layers[0][0]))
        overrides = []
        for other in names:
            if other.startswith(name + "::"):
                strongest = self.ranked(other, path)[:1]
                if strongest and strongest[0][0].target:
                    overrides.append({"slot": other, **self.source(*strongest[0], path)})
        if overrides:
            layer["overrides"] = overrides
        return layer

    def primitive(self, path):
        names = sorted({assign.name for assign in self.assigns} | {re.split(r"::|\|", assign.name)[0] for assign in self.assigns},
                       key=self.name_key)
        result = {"path": path, "layers": []}
        for name in names:
            if "::" in name or "|" in name:
                continue
            for kind in "volume", "light":
                beside = [one for one in self.chain_of(name, path) if one[0].kind == kind]
                if beside:
                    result[kind] = {"slot": name, **self.source(*beside[0], path), **self.variants_of(beside[0][0])}
            layer = self.layer(name, names, path)
            if not layer:
                continue
            vertical = [self.layer(other, names, path) for other in names if other.startswith(name + "|") and "::" not in other]
            vertical = [one for one in vertical if one]
            if vertical:
                layer["vertical"] = vertical
            result["layers"].append(layer)
        result.update(self.idle(names, result, path))
        return result

    def idle(self, names, result, path):
        """The names that are removed, and those that sleep: they have a material, and no layer."""
        said, idle = set(re.findall(r"'slot': '([^']*)'", str(result))), {"removed": [], "asleep": []}
        for name in names:
            ranked = self.ranked(name, path)
            if ranked and not ranked[0][0].target and len(ranked) > 1:
                place = ranked[0][1]
                idle["removed"].append({"slot": name, "from": place, "inherited": place != path, "assign": ranked[0][0].label})
            elif ranked and ranked[0][0].target and name not in said:
                idle["asleep"].append({"slot": name, **self.source(*ranked[0], path)})
        return {key: value for key, value in idle.items() if value}

    def resolve(self):
        return [self.primitive(path) for path in self.paths]
