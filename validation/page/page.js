"use strict";
const all = [...document.querySelectorAll("details.claim, details.fold")];
function reveal() {
  const place = document.getElementById(decodeURIComponent(location.hash.slice(1)));
  for (let one = place; one; one = one.parentElement) if (one.tagName === "DETAILS") one.open = true;
  if (place) place.scrollIntoView();
}
addEventListener("hashchange", reveal);
document.addEventListener("click", event => {
  const link = event.target.closest('a[href^="#"]');
  if (link && link.hash === location.hash) { event.preventDefault(); reveal(); }
});
addEventListener("beforeprint", () => document.querySelectorAll("details").forEach(one => { one.open = true; }));
const button = document.createElement("button");
button.textContent = "Open all";
button.onclick = () => {
  const open = !all.every(one => one.open);
  all.forEach(one => { one.open = open; });
  button.textContent = open ? "Fold all" : "Open all";
};
document.querySelector("nav").append(button);
reveal();
