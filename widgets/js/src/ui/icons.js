/** The pictures on buttons, as paths in a square of 16. */

const PATHS = {
  play: "M4 2.5v11l9-5.5z",
  pause: "M4 2.5h3v11H4zM9 2.5h3v11H9z",
  previous: "M3 3h1.8v10H3zM13 3v10L5.5 8z",
  next: "M11.2 3H13v10h-1.8zM3 3v10l7.5-5z",
  loop: "M4.5 4h6V1.8L14 4.9l-3.5 3.1V5.8h-6v2.4L2.7 9.6V5.8A1.8 1.8 0 0 1 4.5 4zM11.5 12h-6v2.2L2 11.1 5.5 8v2.2h6V7.8"
    + "l1.8-1.4v3.8a1.8 1.8 0 0 1-1.8 1.8z",
  menu: "M1.5 4h6.2a2.3 2.3 0 0 1 4.4 0h2.4v1.6h-2.4a2.3 2.3 0 0 1-4.4 0H1.5zM14.5 12H8.3a2.3 2.3 0 0 1-4.4 0H1.5v-1.6"
    + "h2.4a2.3 2.3 0 0 1 4.4 0h6.2z",
  camera: "M1.5 4.5h3l1-1.7h5l1 1.7h3v8.7h-13zM8 6a2.6 2.6 0 1 0 0 5.2A2.6 2.6 0 0 0 8 6z",
  close: "M3.3 2.2 8 6.9l4.7-4.7 1.1 1.1L9.1 8l4.7 4.7-1.1 1.1L8 9.1l-4.7 4.7-1.1-1.1L6.9 8 2.2 3.3z",
};

/** @typedef {keyof typeof PATHS} IconName */

const SVG = "http://www.w3.org/2000/svg";

/** @param {IconName} name @returns {SVGSVGElement} */
export function icon(name) {
  const picture = document.createElementNS(SVG, "svg");
  picture.setAttribute("viewBox", "0 0 16 16");
  picture.setAttribute("aria-hidden", "true");
  picture.setAttribute("class", "icon");
  const path = document.createElementNS(SVG, "path");
  path.setAttribute("d", PATHS[name]);
  path.setAttribute("fill-rule", "evenodd");
  picture.append(path);
  return picture;
}

/** Show another picture, if it is another. @param {Element} holder @param {IconName} name */
export function setIcon(holder, name) {
  const picture = holder.querySelector("svg");
  if (!picture || picture.dataset.name === name) return;
  const fresh = icon(name);
  fresh.dataset.name = name;
  picture.replaceWith(fresh);
}
