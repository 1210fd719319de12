/* What is chosen on the live page, as the address has it: either the name of a preset (#unwinding), or all of it in words.

   make(data) -> { parse(text): a view; format(view); nameOf(view): of the preset that it is, if any } */
(function (root) {
  "use strict";
  const { normalized } = root.liveSpace, { SLIDERS } = root.liveSliders, SIDES = ["a", "b"], ITS_OWN = "own";
  const SETTINGS = Object.keys(SLIDERS).filter(name => "usual" in SLIDERS[name]), MAPPED = ["a", "b", "none"];

  function make(data) {
    function startOf(id) {
      const { q, omega, goal } = data.starts.find(one => one.id === id);
      return { start: id, q, omega, goal };
    }
    function expand(text) {
      const { a, b, rest } = data.presets[text] || {};
      return rest ? `a=${a}&b=${b}&${rest}` : text;
    }
    function parse(text) { // of what is wrong, the usual
      const given = new URLSearchParams(expand(text)), view = {};
      const number = word => (word === "none" ? Infinity : Number(word));
      const numbers = name => (given.get(name) || "").split(",").map(Number);
      for (const side of SIDES) view[side] = given.get(side) in root.live.laws ? given.get(side) : data.opening[side];
      const isKnown = data.starts.some(one => one.id === given.get("start"));
      Object.assign(view, startOf(isKnown ? given.get("start") : data.opening.start));
      for (const [name, key, size] of [["q", "q", 4], ["w", "omega", 3], ["goal", "goal", 4]]) {
        const found = numbers(name);
        if (found.length !== size || !found.every(Number.isFinite) || (size === 4 && !found.some(Boolean))) continue;
        Object.assign(view, { [key]: size === 4 ? normalized(found) : found, start: ITS_OWN });
      }
      for (const name of SETTINGS) {
        const { from, to, value, place, usual } = SLIDERS[name], wanted = given.has(name) ? number(given.get(name)) : usual;
        view[name] = wanted >= value(from) && wanted <= value(to) && !Number.isNaN(place(wanted)) ? wanted : usual;
      }
      view.log = given.get("log") === "1";
      view.ball = MAPPED.includes(given.get("ball")) ? given.get("ball") : "a";
      return view;
    }
    function format(view) {
      const { a, b, start, q, omega, goal, log, ball } = view, words = new URLSearchParams({ a, b });
      if (start !== ITS_OWN) words.set("start", start);
      else Object.entries({ q, w: omega, goal }).forEach(([name, value]) => words.set(name, value.join(",")));
      const changed = SETTINGS.filter(name => view[name] !== SLIDERS[name].usual);
      for (const name of changed) words.set(name, view[name] === Infinity ? "none" : view[name]);
      if (log) words.set("log", "1");
      if (ball !== "a") words.set("ball", ball);
      return words.toString().replace(/%2C/g, ",").replace(/%2F/g, "/");
    }
    const names = new Map(Object.keys(data.presets).map(name => [format(parse(name)), name]));
    return { startOf, parse, format, nameOf: view => names.get(format(view)) };
  }
  root.liveAddress = { make, SETTINGS, ITS_OWN };
})(window);
