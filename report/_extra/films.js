/* Films: only that of the reader's theme is loaded. It plays while it is on the screen, unless the reader wants no motion, and
   a button under it stops and starts it. */
(function () {
  "use strict";
  const KINDS = { webm: "video/webm", mp4: "video/mp4" }, root = document.documentElement;
  const wantsStill = () => matchMedia("(prefers-reduced-motion: reduce)").matches;
  const make = (tag, properties) => Object.assign(document.createElement(tag), properties);

  function load(film) {
    const name = film.dataset.film + (root.dataset.theme === "dark" ? "-dark" : ""), isPlaying = !film.paused;
    if (film.dataset.loaded === name) return;
    film.dataset.loaded = name;
    film.poster = `${name}.png`;
    film.replaceChildren(...Object.entries(KINDS).map(([kind, type]) => make("source", { src: `${name}.${kind}`, type })));
    film.load();
    if (isPlaying) play(film);
  }
  function play(film) { film.play().catch(() => {}); } // a browser that refuses leaves the poster and the button
  function attend(film) {
    const button = make("button", { type: "button", className: "film-button", textContent: "Play" });
    let isStopped = wantsStill(); // by the reader
    button.addEventListener("click", () => {
      isStopped = !film.paused;
      if (isStopped) film.pause();
      else play(film);
    });
    for (const change of ["play", "pause"])
      film.addEventListener(change, () => { button.textContent = film.paused ? "Play" : "Pause"; });
    film.after(button);
    new IntersectionObserver(([{ isIntersecting }]) => {
      if (isIntersecting) load(film);
      if (!isIntersecting) film.pause();
      else if (!isStopped) play(film);
    }, { threshold: 0.4 }).observe(film);
  }
  const films = [...document.querySelectorAll("video[data-film]")];
  for (const film of films) {
    film.hidden = film.controls = false;
    attend(film);
  }
  addEventListener("beforeprint", () => films.forEach(load)); // for their posters
  new MutationObserver(() => films.filter(film => film.dataset.loaded).forEach(load))
    .observe(root, { attributeFilter: ["data-theme"] });
})();
