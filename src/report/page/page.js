"use strict";
// The page is whole without this: it adds hover texts for touch and keyboard, a choice of charts, and sorted tables.
const tip = document.getElementById("tip");
for (const title of document.querySelectorAll(".point > title")) {
  const point = title.parentNode;
  point.dataset.tip = title.textContent;
  point.setAttribute("aria-label", title.textContent);
  title.remove();
}
function show(point, x, y) {
  tip.textContent = point.dataset.tip;
  tip.hidden = false;
  const box = tip.getBoundingClientRect();
  const wide = document.documentElement.clientWidth;
  const left = Math.max(4, Math.min(x + 14, wide - box.width - 4));
  const top = y + 18 + box.height > window.innerHeight ? y - box.height - 12 : y + 18;
  tip.style.left = left + window.scrollX + "px";
  tip.style.top = top + window.scrollY + "px";
}
document.addEventListener("pointerover", (event) => {
  const point = event.target.closest(".point");
  if (point) show(point, event.clientX, event.clientY);
  else tip.hidden = true;
});
document.addEventListener("focusin", (event) => {
  if (!event.target.matches(".point")) return;
  const box = event.target.getBoundingClientRect();
  show(event.target, box.right, box.top);
});
document.addEventListener("focusout", () => { tip.hidden = true; });

for (const choice of document.querySelectorAll(".choice")) {
  const sections = [...choice.children];
  const label = document.createElement("label");
  const select = document.createElement("select");
  for (const section of sections) select.add(new Option(section.dataset.name));
  label.append(choice.dataset.label + " ", select);
  choice.prepend(label);
  const update = () => sections.forEach((section, index) => {
    section.style.display = index === select.selectedIndex ? "block" : "none";
  });
  for (const section of sections) section.querySelector("h3").hidden = true;
  select.addEventListener("change", update);
  update();
}

for (const cell of document.querySelectorAll("td[data-value]")) cell.title = cell.dataset.value;

for (const table of document.querySelectorAll("table")) {
  const body = table.tBodies[0];
  const original = [...body.rows];
  [...table.tHead.rows[0].cells].forEach((head, column) => {
    const numeric = original.some((row) => row.cells[column] && row.cells[column].dataset.value !== undefined);
    if (!numeric || original.length < 3) return;
    head.classList.add("number");
    head.dataset.order = "";
    head.tabIndex = 0;
    head.title = "Sort";
    const sort = () => {
      const order = head.dataset.order === "up" ? "down" : head.dataset.order === "down" ? "" : "up";
      for (const other of head.parentNode.cells) if (other.dataset.order) other.dataset.order = "";
      head.dataset.order = order;
      // Cells without a figure stay at the end, whatever the order.
      const value = (row) => Number(row.cells[column].dataset.value ?? NaN);
      const sign = order === "down" ? -1 : 1;
      const rows = order === "" ? original : [...original].sort((a, b) => {
        const [x, y] = [value(a), value(b)];
        return Number.isNaN(x) || Number.isNaN(y) ? Number.isNaN(x) - Number.isNaN(y) : sign * (x - y);
      });
      body.append(...rows);
    };
    head.addEventListener("click", sort);
    head.addEventListener("keydown", (event) => { if (event.key === "Enter") sort(); });
  });
}
