/* The map of advice: a plane of the damping ratio and another number. Each place has the colour of the law that is advised
   in the nearest situation of the plane that was simulated; numbers weigh as in `bench advise`. Without this script, and
   in print, its first view stands as a drawing. */
(function () {
  "use strict";
  const canvas = document.getElementById("advice-map"), source = document.getElementById("advice-data");
  if (!canvas || !source) return;
  const data = JSON.parse(source.textContent), pen = canvas.getContext("2d");
  const said = document.getElementById("advice-said"), keys = document.getElementById("advice-keys");
  const choices = { plane: document.getElementById("advice-plane"), rule: document.getElementById("advice-rule") };
  const EDGE = { left: 66, right: 8, top: 8, bottom: 46 }, BLOCK = 3, STRIPE = 8;
  const FONT = "'Orientation Sans', sans-serif";
  let at = null; // the nearest situation to the pointer

  const isDark = () => document.documentElement.dataset.theme === "dark";
  const onPage = pair => pair[isDark() ? 1 : 0];
  const colour = law => (law < 0 ? "transparent" : onPage(data.laws[law].colour));
  const plane = () => data.planes[choices.plane.value], rule = () => data.rules.indexOf(choices.rule.value);
  const verdict = point => point.verdicts[rule()], lawOf = point => verdict(point)[0];

  function nearest(x, y) {
    const [across, up] = plane().weights;
    let best = null, least = Infinity;
    for (const point of plane().points) {
      const away = (across * (point.x - x)) ** 2 + (up * (point.y - y)) ** 2;
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
  function stripes() { // where no law meets the requirements
    const tile = document.createElement("canvas");
    tile.width = tile.height = STRIPE;
    const own = tile.getContext("2d");
    own.strokeStyle = onPage(data.colours.muted);
    own.beginPath();
    for (const shift of [-STRIPE, 0, STRIPE]) { own.moveTo(shift, STRIPE); own.lineTo(shift + STRIPE, 0); }
    own.stroke();
    return pen.createPattern(tile, "repeat");
  }
  function drawRegions() {
    const { width, height } = box(), none = stripes(), paper = onPage(data.colours.paper);
    let before = []; // the laws of the column on the left
    for (let x = 0; x < width; x += BLOCK) {
      const column = [];
      for (let y = 0; y < height; y += BLOCK) {
        const law = lawOf(nearest((x + BLOCK / 2) / width, (1 - (y + BLOCK / 2) / height) * plane().top));
        const [left, top] = [EDGE.left + x, EDGE.top + y];
        pen.fillStyle = law < 0 ? none : colour(law);
        pen.fillRect(left, top, Math.min(BLOCK, width - x), Math.min(BLOCK, height - y));
        pen.fillStyle = paper; // a thin border, for two laws may both be grey
        if (before.length && before[column.length] !== law) pen.fillRect(left, top, 1, BLOCK);
        if (column.length && column[column.length - 1] !== law) pen.fillRect(left, top, BLOCK, 1);
        column.push(law);
      }
      before = column;
    }
  }
  function drawLetters() {
    Object.assign(pen, { fillStyle: onPage(data.colours.paper), font: `600 16px ${FONT}`, textAlign: "center" });
    for (const [law, x, y] of plane().letters[rule()]) pen.fillText(data.laws[law].letter, across(x), down(y) + 6);
  }
  function drawSituations() {
    for (const point of plane().points) {
      const isChosen = point === at, isBare = lawOf(point) < 0;
      pen.fillStyle = onPage(data.colours[isBare ? "ink" : "paper"]);
      pen.globalAlpha = isChosen ? 1 : 0.6;
      pen.beginPath();
      pen.arc(across(point.x), down(point.y), isChosen ? 5 : 1.2, 0, 7);
      pen.fill();
      if (isChosen) { pen.strokeStyle = onPage(data.colours.ink); pen.lineWidth = 2; pen.stroke(); }
    }
    pen.globalAlpha = 1;
  }
  function drawAxes() {
    Object.assign(pen, { fillStyle: onPage(data.colours.ink), font: `13px ${FONT}`, textAlign: "center" });
    ticks(data.zetas, across, (x, word) => pen.fillText(word, x, canvas.clientHeight - EDGE.bottom + 17));
    pen.fillText(data.across, across(0.5), canvas.clientHeight - 8);
    pen.save();
    pen.translate(14, EDGE.top + box().height / 2);
    pen.rotate(-Math.PI / 2);
    pen.fillText(plane().title, 0, 0);
    pen.restore();
    pen.textAlign = "right";
    ticks(plane().ticks, down, (y, word) => pen.fillText(word, EDGE.left - 6, y + 4));
  }
  function draw() {
    const ratio = window.devicePixelRatio || 1;
    if (!canvas.clientWidth) return; // in print
    canvas.width = Math.round(canvas.clientWidth * ratio);
    canvas.height = Math.round(canvas.clientHeight * ratio);
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    drawRegions();
    drawSituations();
    drawLetters();
    drawAxes();
  }
  function words(point) {
    const [law, time, tied, ours, isFaster] = verdict(point), list = laws => laws.map(one => data.laws[one].name).join(", ");
    if (law < 0) return `${point.words}: ${data.none}.`;
    const ties = tied.length ? ` It ties with ${list(tied)}.` : "";
    const own = ours.length ? ` ${list(ours)} (ours) ${isFaster ? "is faster" : "ties"}.` : "";
    return `${point.words}: ${data.laws[law].name}, 99 % settle in ${time}/√kp.${ties}${own}`;
  }
  function keyOf(law) {
    const key = document.createElement("span"), patch = document.createElement("i");
    if (law < 0) patch.className = "none";
    else { patch.style.background = colour(law); patch.textContent = data.laws[law].letter; }
    key.append(patch, law < 0 ? data.none : data.laws[law].name);
    return key;
  }
  function update() {
    const counts = new Map();
    for (const point of plane().points) counts.set(lawOf(point), (counts.get(lawOf(point)) || 0) + 1);
    const laws = [...counts.keys()].filter(law => law >= 0).sort((a, b) => counts.get(b) - counts.get(a));
    keys.replaceChildren(...[...laws, ...(counts.has(-1) ? [-1] : [])].map(keyOf));
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
  for (const part of document.querySelectorAll(".advice-choices, #advice-map, #advice-keys, #advice-said")) part.hidden = false;
  document.querySelector(".advice-drawn").hidden = true;
  canvas.addEventListener("pointermove", point);
  canvas.addEventListener("pointerdown", point);
  canvas.addEventListener("keydown", step);
  for (const choice of Object.values(choices)) choice.addEventListener("change", () => { at = null; update(); });
  new MutationObserver(update).observe(document.documentElement, { attributeFilter: ["data-theme"] });
  new ResizeObserver(draw).observe(canvas);
  document.fonts.ready.then(draw);
  update();
})();
