// Three pictures, off, on and their difference, become one: a slider moves the border between off and on, and a
// button shows the difference. Without this script the three stand side by side.
for (const triple of document.querySelectorAll(".triple")) {
  const [off, on, difference] = triple.querySelectorAll("img");
  const range = Object.assign(document.createElement("input"), { type: "range", min: 0, max: 100, value: 50 });
  range.setAttribute("aria-label", "border between off and on");
  const button = Object.assign(document.createElement("button"), { type: "button", textContent: "difference" });
  const pair = document.createElement("div");
  pair.className = "pair";
  pair.append(off, on, difference, range);
  for (const [text, side] of [["off", "left"], ["on", "right"]]) {
    const label = Object.assign(document.createElement("span"), { className: side, textContent: text });
    pair.append(label);
  }
  triple.append(pair, button);
  triple.classList.add("live");
  const draw = () => pair.style.setProperty("--border", range.value + "%");
  range.addEventListener("input", draw);
  button.addEventListener("click", () => {
    button.setAttribute("aria-pressed", pair.classList.toggle("difference"));
  });
  draw();
}
