"use strict";
// Filter and order of the cards. Both are kept in the address, so that a link shows the same.
const search = document.querySelector("input");
const status = document.getElementById("status");
const order = document.getElementById("order");
const main = document.querySelector("main");
const cards = Array.from(document.querySelectorAll("article"), (card, index) => ({card, index, text: card.textContent.toLowerCase()}));

function show() {
  const words = search.value.toLowerCase().split(/ +/).filter(word => word);
  let count = 0;
  for (const {card, text} of cards) {
    card.hidden = !(words.every(word => text.includes(word)) && (!status.value || card.classList.contains(status.value)));
    count += !card.hidden;
  }
  document.querySelector("output").textContent = `${count} of ${cards.length}`;
  history.replaceState(null, "", "#" + new URLSearchParams({filter: search.value, status: status.value, order: order.value}));
}

// Cards without such a measure come last; equal ones stay in order.
function sort() {
  const measure = card => Number(card.dataset[order.value] || 0);
  main.append(...cards.slice().sort((a, b) => measure(b.card) - measure(a.card) || a.index - b.index).map(entry => entry.card));
  show();
}

const wanted = new URLSearchParams(location.hash.slice(1));
search.value = wanted.get("filter") || "";
status.value = wanted.get("status") || "";
order.value = wanted.get("order") || "index";
search.addEventListener("input", show);
status.addEventListener("change", show);
order.addEventListener("change", sort);
sort();
