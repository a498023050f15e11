"use strict";

// The impact log: rows by time or by impulse, chatter folded into one row.

function wireLog(root) {
  const body = root.querySelector(".log tbody");
  if (!body) return;
  for (const fold of body.querySelectorAll(".fold")) {
    fold.addEventListener("click", () => {
      const open = fold.getAttribute("aria-expanded") !== "true";
      fold.setAttribute("aria-expanded", String(open));
      for (let row = fold.closest("tr").nextElementSibling; row?.classList.contains("touch"); row = row.nextElementSibling) row.hidden = !open;
    });
  }
  const buttons = root.querySelectorAll("[data-sort]");
  for (const button of buttons) {
    button.addEventListener("click", () => {
      for (const other of buttons) other.setAttribute("aria-pressed", String(other === button));
      sortRows(body, button.dataset.sort);
    });
  }
}

// Rows with what is folded below them; time ascends, impulse descends.
function sortRows(body, key) {
  const groups = [];
  for (const row of [...body.rows]) {
    if (row.classList.contains("touch")) groups[groups.length - 1].push(row);
    else groups.push([row]);
  }
  const value = ([row]) => Number(row.dataset[key]);
  groups.sort((a, b) => (key === "time" ? value(a) - value(b) : value(b) - value(a)));
  body.append(...groups.flat());
}
