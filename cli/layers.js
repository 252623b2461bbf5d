"use strict";
// A tree of primitives with their layers. Only the rows in view are elements of the page, so a million of them stay fluid.
const data = JSON.parse(document.getElementById("data").textContent);
const look = JSON.parse(document.getElementById("look").textContent);
const list = document.getElementById("list"), rows = document.getElementById("rows"), detail = document.getElementById("detail");
const search = document.querySelector("input"), output = document.querySelector("output");
const HEIGHT = 24, LAYER = 0, PRODUCT = 1, OVERRIDE = 2;
const count = data.rows.length / 3;
const name = row => data.rows[3 * row], depth = row => data.rows[3 * row + 1], set = row => data.sets[data.rows[3 * row + 2]];
const parents = new Int32Array(count), ends = new Int32Array(count); // the row behind those below
const folded = new Uint8Array(count);
let shown = new Int32Array(0);

{
  const open = [];
  for (let row = 0; row < count; row++) {
    while (open.length >= depth(row))
      ends[open.pop()] = row;
    parents[row] = open.length ? open[open.length - 1] : -1;
    open.push(row);
  }
  for (const row of open)
    ends[row] = count;
}

function path(row) {
  let text = "";
  for (; row >= 0; row = parents[row])
    text = "/" + name(row) + text;
  return text || "/";
}

// The row of a path; -1: there is none.
function rowOf(text) {
  let row = 0, end = count;
  for (const part of text.split("/").slice(1)) {
    while (row < end && name(row) !== part)
      row = ends[row];
    if (row >= end)
      return -1;
    end = ends[row];
    row++;
  }
  return row - 1;
}

// The row on which an assignment of a depth stands; -1: "/".
function above(row, wanted) {
  while (row >= 0 && depth(row) > wanted)
    row = parents[row];
  return wanted ? row : -1;
}

const label = layer => (layer[0] === PRODUCT ? "+ " : "") + data.texts[layer[1]] + " " + data.texts[layer[2]];

// The rows to show: those under no folded row; in a search the matching ones with the rows above them.
function choose() {
  const words = search.value.toLowerCase().split(/ +/).filter(word => word);
  const found = words.length ? find(words) : null;
  const next = new Int32Array(count);
  let length = 0, matches = 0;
  for (let row = 0; row < count; row++) {
    if (found && !found[row])
      continue;
    next[length++] = row;
    matches += !found || found[row] === 2;
    if (folded[row] && !found)
      row = ends[row] - 1;
  }
  shown = next.subarray(0, length);
  output.textContent = `${found ? matches : count} of ${count} primitives` + (look ? `, look ${look}` : "");
  rows.style.height = HEIGHT * length + "px";
  keep({filter: search.value});
  draw();
}

// The address has what is shown, so that a link shows the same.
function keep(values) {
  const address = new URLSearchParams(location.hash.slice(1));
  for (const [key, value] of Object.entries(values))
    value === "" ? address.delete(key) : address.set(key, value);
  history.replaceState(null, "", "#" + address);
}

// The words in a text, a bit for each.
const bits = (words, text) => words.reduce((sum, word, i) => text.includes(word) ? sum | 1 << i : sum, 0);

// 2: the row matches; 1: one below it does. Words match in the path, and in the layers that are set there. What the path above a row has is
// known when the row comes: only the end of that path, where a word may begin, is looked at again.
function find(words) {
  words = words.slice(0, 31);
  const found = new Uint8Array(count), all = bits(words, words.join(" ")), longest = Math.max(...words.map(word => word.length));
  const ofSets = data.sets.map(layers => bits(words, layers.map(label).join(" ").toLowerCase()));
  const ofPaths = [0], tails = [""]; // by depth
  for (let row = 0; row < count; row++) {
    const level = depth(row), text = tails[level - 1] + "/" + name(row).toLowerCase();
    ofPaths[level] = ofPaths[level - 1] | bits(words, text);
    tails[level] = text.slice(-longest);
    if ((ofPaths[level] | ofSets[data.rows[3 * row + 2]]) !== all)
      continue;
    found[row] = 2;
    for (let up = parents[row]; up >= 0 && !found[up]; up = parents[up])
      found[up] = 1;
  }
  return found;
}

function element(tag, type, text) {
  const made = document.createElement(tag);
  made.className = type;
  made.textContent = text;
  return made;
}

function makeRow(row, place) {
  const made = element("div", "row", ""), title = element("span", "name", "");
  made.style.top = HEIGHT * place + "px";
  made.dataset.row = row;
  title.style.paddingLeft = 8 + 16 * (depth(row) - 1) + "px";
  const fold = element(ends[row] > row + 1 ? "button" : "span", "fold", ends[row] > row + 1 ? (folded[row] ? "\u25b8" : "\u25be") : "");
  title.append(fold, name(row));
  made.append(title);
  set(row).forEach((layer, index) => {
    const button = element("button", layer[3] === depth(row) ? "layer" : "layer inherited", label(layer));
    button.dataset.layer = index;
    made.append(button);
  });
  if (!set(row).length)
    made.append(element("span", "none", "default"));
  return made;
}

function draw() {
  const first = Math.max(0, Math.floor(list.scrollTop / HEIGHT) - 5), last = Math.min(shown.length, first + Math.ceil(list.clientHeight / HEIGHT) + 10);
  const made = [];
  for (let place = first; place < last; place++)
    made.push(makeRow(shown[place], place));
  rows.replaceChildren(...made);
}

function goTo(row) {
  for (let up = parents[row]; up >= 0; up = parents[up])
    folded[up] = 0;
  search.value = "";
  choose();
  list.scrollTop = HEIGHT * Math.max(0, shown.indexOf(row) - 3);
  draw();
}

function link(row) {
  const made = element("a", "place", path(row));
  made.addEventListener("click", () => row >= 0 && goTo(row));
  return made;
}

// ---- Graphs: "path : node (definition)", then lines "    input = value or path" ----

function readGraph(text) {
  const nodes = new Map();
  let node = null;
  for (const line of text.split("\n")) {
    const head = /^(\S+) : (\S+)/.exec(line), input = /^ {4}(\S+) = (.*)$/.exec(line);
    if (head) {
      node = nodes.get(head[1]) || {name: head[1], kind: head[2], inputs: new Map(), column: 0};
      nodes.set(head[1], node);
    } else if (input && node) {
      node.inputs.set(input[1], input[2]);
    }
  }
  return nodes;
}

// The node that an input is connected to, also by "node.output".
const source = (nodes, value) => nodes.get(value) || nodes.get(value.replace(/\.[^./]*$/, ""));

// Sources stand before the nodes that they feed, in the text and in the columns.
function place(nodes) {
  const heights = [];
  for (const node of nodes.values()) {
    for (const value of node.inputs.values()) {
      const from = source(nodes, value);
      if (from && from !== node)
        node.column = Math.max(node.column, from.column + 1);
    }
    node.lines = [...node.inputs].filter(([, value]) => !source(nodes, value)).map(([input, value]) => `${input} = ${value}`);
    node.height = 36 + 14 * node.lines.length;
    node.y = heights[node.column] || 8;
    heights[node.column] = node.y + node.height + 14;
  }
  return {width: 210 * heights.length, height: Math.max(...heights, 0) + 8};
}

function svg(tag, attributes, text) {
  const made = document.createElementNS("http://www.w3.org/2000/svg", tag);
  for (const [key, value] of Object.entries(attributes))
    made.setAttribute(key, value);
  made.textContent = text || "";
  return made;
}

function drawGraph(text) {
  const WIDTH = 170, nodes = readGraph(text), size = place(nodes);
  const made = svg("svg", {class: "graph", width: size.width, height: size.height});
  const x = node => 8 + 210 * node.column;
  for (const node of nodes.values())
    for (const [input, value] of node.inputs) {
      const from = source(nodes, value);
      if (!from)
        continue;
      const ax = x(from) + WIDTH, ay = from.y + 18, bx = x(node), by = node.y + 18, edge = svg("path", {d: `M${ax},${ay} C${ax + 20},${ay} ${bx - 20},${by} ${bx},${by}`});
      edge.append(svg("title", {}, `${value} \u2192 ${input}`));
      made.append(edge);
    }
  const cut = line => line.length > 26 ? line.slice(0, 25) + "\u2026" : line;
  for (const node of nodes.values()) {
    const group = svg("g", {transform: `translate(${x(node)},${node.y})`});
    group.append(svg("rect", {width: WIDTH, height: node.height - 4, rx: 3}), svg("title", {}, [node.name + " : " + node.kind, ...node.lines].join("\n")),
      svg("text", {x: 6, y: 14, class: "kind"}, cut(node.kind)), svg("text", {x: 6, y: 28}, cut(node.name.split("/").pop())));
    node.lines.forEach((line, index) => group.append(svg("text", {x: 6, y: 42 + 14 * index, class: "value"}, cut(line))));
    made.append(group);
  }
  return made;
}

// Picture and graph of a material or an override, and, of an override, the picture of what it drives.
function showSubstance(row, layer) {
  const made = [], substance = data.substances[layer[2]];
  const slot = data.texts[layer[1]].replace(/::.*/, ""), base = set(row).find(other => other[0] !== PRODUCT && data.texts[other[1]] === slot);
  const picture = (substance && substance.picture) || (base && data.substances[base[2]] && data.substances[base[2]].picture);
  if (picture) {
    const image = element("img", "picture", "");
    image.src = picture;
    image.alt = data.texts[substance && substance.picture ? layer[2] : base[2]];
    made.push(image);
  }
  if (substance && substance.graph) {
    const box = element("div", "graphs", "");
    box.append(drawGraph(substance.graph));
    made.push(element("h2", "", "graph"), box);
  }
  return made;
}

// Where a layer comes from, every place where its slot is set, and what it is.
function tell(row, layer) {
  const MOST = 200, from = above(row, layer[3]), terms = document.createElement("dl"), places = element("ul", "places", "");
  const add = (term, value) => {
    const made = element("dd", term, "");
    made.append(value);
    terms.append(element("dt", "", term), made);
  };
  add("primitive", path(row));
  add("slot", data.texts[layer[1]]);
  add(layer[0] === OVERRIDE ? "override" : "material", data.texts[layer[2]]);
  add("comes from", link(from));
  add("assignment", data.texts[layer[4]]);
  let number = 0;
  const atRoot = data.sets.flat().find(other => other[1] === layer[1] && other[0] === layer[0] && !other[3]);
  if (atRoot) {
    places.append(element("li", "", "/ " + data.texts[atRoot[2]]));
    number++;
  }
  for (let at = 0; at < count; at++)
    for (const other of set(at))
      if (other[1] === layer[1] && other[0] === layer[0] && other[3] === depth(at) && number++ < MOST) {
        const item = document.createElement("li");
        item.append(link(at), " " + data.texts[other[2]]);
        places.append(item);
      }
  keep({at: path(row), layer: set(row).indexOf(layer)});
  detail.replaceChildren(element("h2", "", label(layer)), terms, ...showSubstance(row, layer), element("h2", "", `set at ${number} path${number === 1 ? "" : "s"}`), places);
}

rows.addEventListener("click", event => {
  const at = event.target.closest(".row");
  if (!at)
    return;
  const row = Number(at.dataset.row);
  if (event.target.matches("button.fold")) {
    folded[row] = 1 - folded[row];
    choose();
  } else if (event.target.matches("button.layer")) {
    tell(row, set(row)[Number(event.target.dataset.layer)]);
  }
});
document.getElementById("fold").addEventListener("click", () => { folded.fill(1); keep({fold: "all"}); choose(); });
document.getElementById("unfold").addEventListener("click", () => { folded.fill(0); keep({fold: ""}); choose(); });
search.addEventListener("input", () => { list.scrollTop = 0; choose(); });
list.addEventListener("scroll", draw);
addEventListener("resize", draw);

function open() {
  const wanted = new URLSearchParams(location.hash.slice(1)), at = wanted.get("at");
  search.value = wanted.get("filter") || "";
  if (wanted.get("fold") === "all")
    folded.fill(1);
  choose();
  const row = at ? rowOf(at) : -1;
  if (row < 0)
    return;
  const layer = set(row)[Number(wanted.get("layer") || 0)];
  if (!search.value)
    goTo(row);
  if (layer)
    tell(row, layer);
}
open();
