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

// 2: the row matches; 1: one below it does. Words match in the path, and in the layers that are set there.
function find(words) {
  const found = new Uint8Array(count);
  const layers = data.sets.map(layers => layers.map(label).join(" ").toLowerCase());
  for (let row = 0; row < count; row++) {
    const text = path(row).toLowerCase() + " " + layers[data.rows[3 * row + 2]];
    if (!words.every(word => text.includes(word)))
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

// Where a layer comes from, and every place where its slot is set.
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
  detail.replaceChildren(element("h2", "", label(layer)), terms, element("h2", "", `set at ${number} path${number === 1 ? "" : "s"}`), places);
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
  for (let row = 0; at && row < count; row++)
    if (path(row) === at) {
      const layer = set(row)[Number(wanted.get("layer") || 0)];
      if (!search.value)
        goTo(row);
      if (layer)
        tell(row, layer);
      break;
    }
}
open();
