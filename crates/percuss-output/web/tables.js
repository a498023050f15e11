"use strict";

// Tables: the name of its column beside each cell, for narrow screens, and a cue where a table is wider than its place.

function wireTables(root) {
  const tables = [...root.querySelectorAll(".table")];
  for (const table of tables) {
    const names = [...table.querySelectorAll("thead th")].map((th) => th.textContent);
    table.classList.toggle("named", names.length > 0);
    for (const row of table.querySelectorAll("tbody tr")) {
      [...row.cells].forEach((cell, k) => {
        if (k && names[k]) cell.dataset.label = names[k];
      });
    }
  }
  // What is cut can be scrolled with the keyboard, and says so.
  const measure = () => {
    for (const table of tables) {
      const cut = table.scrollWidth > table.clientWidth + 1;
      table.classList.toggle("cut", cut);
      if (cut) Object.entries({ tabindex: "0", role: "region", "aria-label": table.querySelector("caption")?.textContent || "Table" }).forEach(([name, value]) => table.setAttribute(name, value));
      else ["tabindex", "role", "aria-label"].forEach((name) => table.removeAttribute(name));
    }
  };
  measure();
  addEventListener("resize", measure);
  root.addEventListener("toggle", measure, true);
}
