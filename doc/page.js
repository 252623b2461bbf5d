"use strict";
// Search, and the mark at the node that is read. Without any of this the page is a page.
const search = document.querySelector("nav input");
const none = document.getElementById("none");
const entries = Array.from(document.querySelectorAll("article"), article => ({
  article, name: article.id.toLowerCase(), text: article.textContent.toLowerCase(),
  link: document.querySelector(`nav a[href="#${CSS.escape(article.id)}"]`),
}));
const list = document.querySelector("nav div");
const sections = Array.from(document.querySelectorAll("section"));

// An entry stays when it has all words; Enter goes to the one whose name fits best.
function filter() {
  const words = search.value.toLowerCase().split(/ +/).filter(word => word);
  let found = false;
  for (const entry of entries) {
    const fits = words.every(word => entry.text.includes(word));
    entry.article.hidden = entry.link.parentElement.hidden = !fits;
    found = found || fits;
  }
  for (const section of sections)
    section.hidden = !section.querySelector("article:not([hidden]), nav li:not([hidden])");
  none.hidden = found;
}

function best() {
  const word = search.value.trim().toLowerCase();
  const shown = entries.filter(entry => !entry.article.hidden);
  return shown.find(entry => entry.name === word) || shown.find(entry => entry.name.startsWith(word)) ||
    shown.find(entry => entry.name.includes(word)) || shown[0];
}

search.hidden = false;
search.addEventListener("input", filter);
search.addEventListener("keydown", event => {
  if (event.key === "Escape") {
    search.value = "";
    filter();
  } else if (event.key === "Enter") {
    const entry = best();
    if (entry) location.hash = entry.article.id;
  }
});
document.addEventListener("keydown", event => {
  if (event.key !== "/" || event.target === search) return;
  event.preventDefault();
  search.focus();
});

// The topmost article in sight is the one that is read.
const seen = new Set();
let here = null;
const observer = new IntersectionObserver(changes => {
  for (const change of changes) seen[change.isIntersecting ? "add" : "delete"](change.target);
  const entry = entries.find(candidate => seen.has(candidate.article));
  if (!entry || entry.link === here) return;
  if (here) here.classList.remove("here");
  here = entry.link;
  here.classList.add("here");
  // Not scrollIntoView: where the list stands above the text, that would scroll the page.
  const below = here.offsetTop - list.scrollTop;
  if (0 > below || below > list.clientHeight - 40) list.scrollTop = here.offsetTop - list.clientHeight / 2;
});
for (const entry of entries) observer.observe(entry.article);
