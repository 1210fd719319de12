/* A ball of points that the reader turns: no library, follows light and dark, works with mouse, finger and keyboard.
   Draws every <canvas class="ball"> from the <script type="application/json" data-for="its id"> beside it. */
(function () {
  "use strict";
  const START = { yaw: 0.6, pitch: 0.35 }, STEP = 0.12, CIRCLE = 96;

  function ring(at) {
    return Array.from({ length: CIRCLE + 1 }, (_, i) => at((2 * Math.PI * i) / CIRCLE));
  }
  const RINGS = [ring(t => [Math.cos(t), Math.sin(t), 0]), ring(t => [Math.cos(t), 0, Math.sin(t)]),
                 ring(t => [0, Math.cos(t), Math.sin(t)])];
  const AXES = [["x", [1, 0, 0]], ["y", [0, 1, 0]], ["z", [0, 0, 1]]];

  function start(canvas) {
    const source = document.querySelector(`script[data-for="${canvas.id}"]`);
    if (!source) return;
    const data = JSON.parse(source.textContent), pen = canvas.getContext("2d");
    const groups = Object.entries(data.groups);
    let { yaw, pitch } = START, held = null, size = 0;

    function isDark() { return document.documentElement.dataset.theme === "dark"; }
    function project([x, y, z]) { // x right, z up, depth towards the reader
      const a = Math.cos(yaw) * x - Math.sin(yaw) * y, b = Math.sin(yaw) * x + Math.cos(yaw) * y;
      const r = size * 0.41;
      return [size / 2 + r * a, size * 0.47 - r * (Math.cos(pitch) * z + Math.sin(pitch) * b),
              Math.sin(pitch) * z - Math.cos(pitch) * b];
    }
    function draw() {
      const ratio = window.devicePixelRatio || 1, dark = isDark();
      size = canvas.clientWidth;
      canvas.width = canvas.height = Math.round(size * ratio);
      pen.setTransform(ratio, 0, 0, ratio, 0, 0);
      pen.clearRect(0, 0, size, size);
      const ink = dark ? "#e6eaf0" : "#1c2430", line = dark ? "#56616f" : "#b9c3cf";
      pen.lineWidth = 1;
      pen.strokeStyle = line;
      pen.beginPath(); pen.arc(size / 2, size * 0.47, size * 0.41, 0, 7); pen.stroke();
      for (const points of RINGS) {
        for (let i = 0; i < CIRCLE; i++) {
          const p = project(points[i]), q = project(points[i + 1]);
          pen.globalAlpha = p[2] > 0 ? 0.9 : 0.3;
          pen.beginPath(); pen.moveTo(p[0], p[1]); pen.lineTo(q[0], q[1]); pen.stroke();
        }
      }
      const dots = [];
      for (const [, group] of groups)
        for (const xyz of group.xyz) dots.push([project(xyz), dark ? group.dark : group.colour]);
      dots.sort((a, b) => a[0][2] - b[0][2]);
      const radius = Math.max(1.6, size / 240);
      for (const [[x, y, depth], colour] of dots) {
        pen.globalAlpha = 0.45 + 0.5 * (depth + 1) / 2;
        pen.fillStyle = colour;
        pen.beginPath(); pen.arc(x, y, radius * (1 + 0.35 * depth), 0, 7); pen.fill();
      }
      pen.globalAlpha = 1;
      pen.fillStyle = ink;
      pen.font = "600 14px 'Orientation Sans', sans-serif";
      pen.textAlign = "center";
      for (const [name, tip] of AXES) {
        const p = project(tip.map(v => 1.08 * v));
        pen.globalAlpha = p[2] > -0.2 ? 1 : 0.45;
        pen.fillText(`${name} = ${data.radius}`, p[0], p[1] + 5);
      }
      pen.globalAlpha = 1;
      pen.textAlign = "left";
      pen.font = "14px 'Orientation Sans', sans-serif";
      const keys = groups.map(([name, group]) => ({ name, group, width: 32 + pen.measureText(name).width }));
      const rows = [[]]; // as many keys in a row as fit
      for (const key of keys) {
        const used = rows[rows.length - 1].reduce((sum, other) => sum + other.width, 4);
        if (used > 4 && used + key.width - 17 > size) rows.push([]);
        rows[rows.length - 1].push(key);
      }
      rows.forEach((row, i) => {
        let x = 4;
        const y = size - 10 - 20 * (rows.length - 1 - i);
        for (const { name, group, width } of row) {
          pen.fillStyle = dark ? group.dark : group.colour;
          pen.beginPath(); pen.arc(x + 5, y, 5, 0, 7); pen.fill();
          pen.fillStyle = ink;
          pen.fillText(name, x + 15, y + 5);
          x += width;
        }
      });
    }
    function turn(dx, dy) {
      yaw += dx;
      pitch = Math.max(-1.5, Math.min(1.5, pitch + dy));
      draw();
    }
    canvas.addEventListener("pointerdown", e => { held = [e.clientX, e.clientY]; canvas.setPointerCapture(e.pointerId); });
    canvas.addEventListener("pointermove", e => {
      if (!held) return;
      turn((e.clientX - held[0]) / 150, (e.clientY - held[1]) / 150);
      held = [e.clientX, e.clientY];
    });
    for (const end of ["pointerup", "pointercancel"]) canvas.addEventListener(end, () => { held = null; });
    canvas.addEventListener("dblclick", () => { ({ yaw, pitch } = START); draw(); });
    canvas.addEventListener("keydown", e => {
      const way = { ArrowLeft: [-STEP, 0], ArrowRight: [STEP, 0], ArrowUp: [0, -STEP], ArrowDown: [0, STEP] }[e.key];
      if (!way) return;
      e.preventDefault();
      turn(...way);
    });
    new ResizeObserver(draw).observe(canvas);
    new MutationObserver(draw).observe(document.documentElement, { attributeFilter: ["data-theme"] });
    document.fonts.ready.then(draw);
  }
  function startAll() { document.querySelectorAll("canvas.ball").forEach(start); }
  if (document.readyState === "loading") document.addEventListener("DOMContentLoaded", startAll); else startAll();
})();
