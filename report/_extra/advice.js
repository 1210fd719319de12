/* The map of advice: a plane of the damping ratio and another number, coloured by the law that is advised there.
   Each point of the plane has the colour of the nearest situation that was simulated, as `bench advise` answers. */
(function () {
  "use strict";
  const canvas = document.getElementById("advice-map"), source = document.getElementById("advice-data");
  if (!canvas || !source) return;
  const data = JSON.parse(source.textContent), pen = canvas.getContext("2d");
  const said = document.getElementById("advice-said"), keys = document.getElementById("advice-keys");
  const choices = { plane: document.getElementById("advice-plane"), rule: document.getElementById("advice-rule") };
  const EDGE = { left: 58, right: 8, top: 8, bottom: 46 }, BLOCK = 4;
  let at = null; // the nearest situation to the pointer

  const isDark = () => document.documentElement.dataset.theme === "dark";
  const colour = law => (law < 0 ? (isDark() ? "#343c48" : "#dfe3e8") : data.laws[law].colour[isDark() ? 1 : 0]);
  const plane = () => data.planes[choices.plane.value];
  const verdict = point => point.verdicts[data.rules.indexOf(choices.rule.value)];

  function nearest(x, y) {
    let best = null, least = Infinity;
    for (const point of plane().points) {
      const away = (point.x - x) ** 2 + (point.y - y) ** 2;
      if (away < least) [best, least] = [point, away];
    }
    return best;
  }
  function box() {
    return { width: canvas.clientWidth - EDGE.left - EDGE.right, height: canvas.clientHeight - EDGE.top - EDGE.bottom };
  }
  const across = x => EDGE.left + x * box().width;
  const down = y => EDGE.top + (1 - y / plane().top) * box().height;

  function ticks(list, place, draw) { // each tick's word where it does not run into the one before
    let last = -Infinity;
    for (const [value, word] of list) if (Math.abs(place(value) - last) > 26) draw(last = place(value), word);
  }
  function draw() {
    const ratio = window.devicePixelRatio || 1, { width, height } = box(), ink = isDark() ? "#e6eaf0" : "#1c2430";
    canvas.width = Math.round(canvas.clientWidth * ratio);
    canvas.height = Math.round(canvas.clientHeight * ratio);
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    for (let x = 0; x < width; x += BLOCK)
      for (let y = 0; y < height; y += BLOCK) {
        pen.fillStyle = colour(verdict(nearest((x + BLOCK / 2) / width, (1 - (y + BLOCK / 2) / height) * plane().top)).law);
        pen.fillRect(EDGE.left + x, EDGE.top + y, Math.min(BLOCK, width - x), Math.min(BLOCK, height - y));
      }
    pen.fillStyle = pen.strokeStyle = ink;
    pen.font = "13px 'Orientation Sans', sans-serif";
    for (const point of plane().points) {
      pen.globalAlpha = point === at ? 1 : 0.35;
      pen.beginPath(); pen.arc(across(point.x), down(point.y), point === at ? 4 : 1.3, 0, 7); pen.fill();
    }
    pen.globalAlpha = 1;
    pen.textAlign = "center";
    ticks(data.zetas, across, (x, word) => pen.fillText(word, x, canvas.clientHeight - EDGE.bottom + 17));
    pen.fillText("damping ratio kv/(2√kp)", across(0.5), canvas.clientHeight - 8);
    pen.textAlign = "right";
    ticks(plane().ticks, down, (y, word) => pen.fillText(word, EDGE.left - 6, y + 4));
  }
  function words(point) {
    const one = verdict(point);
    if (one.law < 0) return `${point.words}: no published or adapted law meets the requirements.`;
    const ties = one.tied.length ? ` It ties with ${one.tied.map(law => data.laws[law].name).join(", ")}.` : "";
    const ours = one.ours.length ? ` ${one.ours.map(law => data.laws[law].name).join(", ")} (ours) ${one.faster ? "is faster" : "ties"}.` : "";
    return `${point.words}: ${data.laws[one.law].name}, 99 % settle in ${one.time}/√kp.${ties}${ours}`;
  }
  function update() {
    const present = new Set(plane().points.map(point => verdict(point).law));
    keys.replaceChildren(...data.laws.map((law, i) => [law, i]).filter(([, i]) => present.has(i)).map(([law, i]) => {
      const key = document.createElement("span"), patch = document.createElement("i");
      patch.style.background = colour(i);
      key.append(patch, law.name);
      return key;
    }));
    said.textContent = at ? words(at) : "Point at the map, or use the arrow keys, to read a situation.";
    draw();
  }
  function point(event) {
    const { left, top } = canvas.getBoundingClientRect(), { width, height } = box();
    at = nearest((event.clientX - left - EDGE.left) / width, (1 - (event.clientY - top - EDGE.top) / height) * plane().top);
    update();
  }
  function step(event) {
    const move = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[event.key];
    if (!move) return;
    event.preventDefault();
    const from = at || nearest(0.5, 0.5 * plane().top);
    const ahead = plane().points.filter(one => move[0] * (one.x - from.x) + move[1] * (one.y - from.y) > 1e-6);
    const away = one => Math.hypot((one.x - from.x) * (move[0] ? 1 : 4), (one.y - from.y) * (move[1] ? 1 : 4));
    at = ahead.sort((a, b) => away(a) - away(b))[0] || from;
    update();
  }
  canvas.addEventListener("pointermove", point);
  canvas.addEventListener("pointerdown", point);
  canvas.addEventListener("keydown", step);
  for (const choice of Object.values(choices)) choice.addEventListener("change", () => { at = null; update(); });
  new MutationObserver(update).observe(document.documentElement, { attributeFilter: ["data-theme"] });
  new ResizeObserver(draw).observe(canvas);
  update();
})();
