/* A quantity over time, of two laws, in an SVG of its own; a ring where a law settles, a cross where it breaks off. */
(function (root) {
  "use strict";
  const SVG = "http://www.w3.org/2000/svg", BOX = { left: 44, right: 8, top: 8, bottom: 24, height: 170 };

  function add(parent, name, attributes, text) {
    const element = document.createElementNS(SVG, name);
    for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
    if (text !== undefined) element.textContent = text;
    parent.append(element);
    return element;
  }
  function ticks(from, to, most) { // steps of 1, 2 or 5 times a power of ten
    const span = to - from, power = 10 ** Math.floor(Math.log10(span / most));
    const size = [1, 2, 5, 10].map(n => n * power).find(one => span / one <= most);
    const count = Math.floor(span / size + 1e-9);
    return Array.from({ length: count + 1 }, (_, i) => Number((from + i * size).toPrecision(12)));
  }
  function decades(from, to) {
    const first = Math.ceil(Math.log10(from) - 1e-9), last = Math.floor(Math.log10(to) + 1e-9);
    const every = Math.ceil((last - first + 1) / 5);
    return Array.from({ length: Math.floor((last - first) / every) + 1 }, (_, i) => 10 ** (first + i * every));
  }
  const raised = power => String(power).replace(/./g, sign => "⁰¹²³⁴⁵⁶⁷⁸⁹"[sign] || "⁻");
  function numberText(value) { // 0.01, 150, 20 000, 2·10⁵
    if (value < 1e5 && (value === 0 || value >= 0.01))
      return value.toLocaleString("en", { maximumFractionDigits: 4 }).replace(/,/g, "\u202f");
    const power = Math.floor(Math.log10(value) + 1e-9), mantissa = Number((value / 10 ** power).toPrecision(3));
    return `${mantissa === 1 ? "" : `${mantissa}·`}10${raised(power)}`;
  }

  function make(svg, floor) {
    let place, marks, shown;

    function scales({ curves, end, isLog }) {
      const width = svg.clientWidth, values = curves.flatMap(one => one.values).filter(Number.isFinite);
      const top = values.reduce((p, q) => Math.max(p, q), 10 * floor), inner = BOX.height - BOX.top - BOX.bottom;
      const part = isLog ? v => Math.log(Math.max(v, floor) / floor) / Math.log(top / floor) : v => v / (1.04 * top);
      return {
        width, end, top,
        x: time => BOX.left + (time / end) * (width - BOX.left - BOX.right),
        y: value => BOX.height - BOX.bottom - inner * Math.min(1, part(value)),
      };
    }
    function drawAxes() {
      const { width, end, top, x, y } = place, bottom = BOX.height - BOX.bottom;
      for (const value of shown.isLog ? decades(floor, top) : ticks(0, top, 4)) {
        add(svg, "line", { class: "grid", x1: BOX.left, x2: width - BOX.right, y1: y(value), y2: y(value) });
        add(svg, "text", { x: BOX.left - 6, y: y(value) + 4, "text-anchor": "end" }, numberText(value));
      }
      for (const time of ticks(0, end, width < 420 ? 4 : 7)) {
        add(svg, "line", { class: "grid", x1: x(time), x2: x(time), y1: BOX.top, y2: bottom });
        add(svg, "text", { x: x(time), y: BOX.height - 7, "text-anchor": "middle" }, `${numberText(time)} s`);
      }
      add(svg, "line", { class: "axis", x1: BOX.left, x2: width - BOX.right, y1: bottom, y2: bottom });
    }
    function drawCurve({ side, values, step_s, settling_s, hasFailed, dashes }) {
      const { x, y } = place;
      let path = "", pen = "M";
      values.forEach((value, i) => {
        if (!Number.isFinite(value)) { pen = "M"; return; }
        path += `${pen}${x(i * step_s).toFixed(1)} ${y(value).toFixed(1)}`;
        pen = "L";
      });
      add(svg, "path", { class: `curve ${side}`, d: path, "stroke-dasharray": dashes.join(" ") });
      const last = values.length - 1;
      if (shown.band !== undefined && settling_s !== null && settling_s !== undefined) {
        const level = y(values[Math.min(Math.round(settling_s / step_s), last)]);
        add(svg, "circle", { class: `ring ${side}`, cx: x(settling_s), cy: level, r: 4.5 });
      } else if (hasFailed && Number.isFinite(values[last])) {
        add(svg, "path", { class: `cross ${side}`, d: `M${x(last * step_s) - 5} ${y(values[last]) - 5}l10 10m0 -10l-10 10` });
      }
    }
    function draw(given = shown) { // { curves, end, isLog, band, time }
      shown = given;
      svg.replaceChildren();
      svg.setAttribute("height", BOX.height);
      place = scales(shown);
      drawAxes();
      if (shown.band !== undefined) {
        const level = place.y(shown.band);
        add(svg, "line", { class: "band", x1: BOX.left, x2: place.width - BOX.right, y1: level, y2: level });
      }
      shown.curves.forEach(drawCurve);
      marks = {
        line: add(svg, "line", { class: "now", y1: BOX.top, y2: BOX.height - BOX.bottom }),
        a: add(svg, "circle", { class: "mark a", r: 5 }),
        b: add(svg, "rect", { class: "mark b", width: 9, height: 9 }),
      };
      mark(shown.time);
    }
    function mark(time) {
      const { x, y } = place;
      for (const end of ["x1", "x2"]) marks.line.setAttribute(end, x(time));
      for (const { side, values, step_s } of shown.curves) {
        const i = Math.min(Math.round(time / step_s), values.length - 1), value = values[i];
        marks[side].setAttribute("visibility", Number.isFinite(value) ? "visible" : "hidden");
        if (!Number.isFinite(value)) continue;
        const [across, down] = side === "a" ? ["cx", "cy"] : ["x", "y"], half = side === "a" ? 0 : 4.5;
        marks[side].setAttribute(across, x(Math.min(time, (values.length - 1) * step_s)) - half);
        marks[side].setAttribute(down, y(value) - half);
      }
    }
    return { draw, mark };
  }
  root.livePlot = { make };
})(window);
