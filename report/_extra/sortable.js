/* Tables marked `sortable`: a head sorts its column, a field above shows only the rows that hold a text.
   Numbers are compared as numbers, a dash or "never" comes last both ways; the order of the page comes back at the third press. */
(function () {
  "use strict";
  const LETTERS = new Intl.Collator(undefined, { numeric: true, sensitivity: "base" });

  const plain = digits => digits.replace(/./g, sign => { const i = "⁰¹²³⁴⁵⁶⁷⁸⁹".indexOf(sign); return i < 0 ? "-" : i; });
  const withoutPowers = text => text.replace(/(?:(\d(?:\.\d+)?)·)?10([⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+)/, (_, first, power) => `${first || 1}e${plain(power)}`);

  function value(cell) {
    const text = cell ? cell.innerText.trim() : "";
    const digits = withoutPowers(text).replace(/^none\b/, "0").replace(/[\s\u00a0\u202f,]/g, "").replace("\u2212", "-");
    const number = digits.match(/^[<>=]*(-?\d+(?:\.\d+)?(?:e-?\d+)?)/);
    return { text, number: number ? Number(number[1]) : null, isLast: text === "" || text === "\u2013" || text === "never" };
  }

  function compared(a, b) {
    return a.number !== null && b.number !== null ? a.number - b.number : LETTERS.compare(a.text, b.text);
  }

  function sorted(rows, column, direction) {
    if (!direction) return rows;
    const keyed = rows.map(row => ({ row, key: value(row.cells[column]) }));
    keyed.sort((a, b) => (a.key.isLast - b.key.isLast) || (a.key.isLast ? 0 : direction * compared(a.key, b.key)));
    return keyed.map(one => one.row);
  }

  function prepare(table) {
    const body = table.tBodies[0], heads = [...table.tHead.rows[0].cells], rows = [...body.rows];
    const next = { none: ["ascending", 1], ascending: ["descending", -1], descending: ["none", 0] };
    heads.forEach((head, column) => {
      if (!head.innerText.trim()) return;
      const button = document.createElement("button");
      button.type = "button";
      button.append(...head.childNodes);
      head.append(button);
      head.setAttribute("aria-sort", "none");
      button.addEventListener("click", () => {
        const [state, direction] = next[head.getAttribute("aria-sort")];
        heads.forEach(other => other.hasAttribute("aria-sort") && other.setAttribute("aria-sort", "none"));
        head.setAttribute("aria-sort", state);
        body.append(...sorted(rows, column, direction));
      });
    });
    const label = document.createElement("label"), field = document.createElement("input"), count = document.createElement("output");
    label.className = "filter";
    field.type = "search";
    label.append("Only rows with ", field, count);
    const show = () => {
      const words = field.value.trim().toLowerCase();
      rows.forEach(row => { row.hidden = !row.textContent.toLowerCase().includes(words); });
      const left = rows.filter(row => !row.hidden).length;
      count.textContent = words ? ` ${left} of ${rows.length}` : "";
    };
    field.addEventListener("input", show);
    (table.closest(".pst-scrollable-table-container") || table).before(label);
  }

  document.querySelectorAll("table.sortable").forEach(table => table.tHead && table.tBodies.length && prepare(table));
})();
