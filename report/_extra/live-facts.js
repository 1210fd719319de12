/* What is said of the two laws of the live page: a sentence each, a table, and their code to copy. */
(function (root) {
  "use strict";
  const { ending, turned, peak } = root.liveWords, SIDES = ["a", "b"];
  const byId = id => document.getElementById(`live-${id}`);
  const make = (tag, properties) => Object.assign(document.createElement(tag), properties);

  function copyText(text, button) { // works from a file too, where the clipboard of pages does not
    const area = make("textarea", { value: text, className: "live-copied" });
    button.after(area);
    area.select();
    const isCopied = document.execCommand("copy");
    area.remove();
    button.dataset.copied = isCopied ? text : "";
    button.textContent = isCopied ? "Copied" : "Not copied";
    button.focus();
  }
  function codeOf(word, name) { // the very functions that run here
    const { needs, memory } = root.live.laws[word], law = needs[needs.length - 1];
    const usage = memory ? `[u, memory] = ${law}(R, omega, goal, [kp, kv, bound, delay], memory); memory = ${JSON.stringify(memory)} at first`
      : `u = ${law}(R, omega, goal, [kp, kv, bound, delay])`;
    const lines = [`// ${name}: ${usage}`, "// R: its three columns; goal = [R_d, [0, 0, 0], [0, 0, 0]]; base frame"];
    return [...lines, ...needs.map(one => root.live.functions[one].toString())].join("\n\n") + "\n";
  }
  function codeCell(side, word, { name, card }) {
    const button = make("button", { type: "button", textContent: "Copy" });
    button.setAttribute("aria-label", `Copy law ${side.toUpperCase()} as JavaScript`);
    button.addEventListener("click", () => copyText(codeOf(word, name), button));
    const cell = make("span", { className: "live-code" });
    cell.append(button, " ", make("a", { href: card, textContent: "C, C++, Python" }));
    return cell;
  }
  function fill(view, episodes, { laws, rules }) {
    const rows = [
      ["Full name of the law", side => make("a", { href: laws[view[side]].card, textContent: laws[view[side]].title })],
      ["Rotation of the body, total", side => turned(episodes[side])],
      ["Largest command", side => peak(episodes[side], rules)],
      ["Operations in a control step", side => laws[view[side]].cost],
      ["Code of the law", side => codeCell(side, view[side], laws[view[side]])],
    ];
    const table = document.querySelector(".live-facts");
    for (const side of SIDES) table.querySelector(`th.${side}`).textContent = laws[view[side]].name;
    table.tBodies[0].replaceChildren(...rows.map(([label, value]) => {
      const row = make("tr");
      row.append(make("th", { scope: "row", textContent: label }), make("td"), make("td"));
      SIDES.forEach((side, i) => row.cells[i + 1].append(value(side)));
      return row;
    }));
  }
  function wait(view, { laws }) { // what was said holds no longer
    byId("said").setAttribute("aria-busy", "true");
    put(SIDES.map(side => `${side.toUpperCase()}: ${laws[view[side]].name}: computing …`));
    document.querySelector(".live-facts").tBodies[0].replaceChildren();
  }
  function say(view, episodes, data) { // to be seen, and to be read out
    put(SIDES.map(side =>
      `${side.toUpperCase()}: ${data.laws[view[side]].name} ${ending(episodes[side], data.rules)}.`));
    byId("said").setAttribute("aria-busy", "false");
    fill(view, episodes, data);
  }
  function put(lines) {
    const spans = lines.map((line, i) => make("span", { className: SIDES[i], textContent: line }));
    byId("said").replaceChildren(...spans.flatMap(span => [span, " "]));
  }
  root.liveFacts = { wait, say, copyText };
})(window);
