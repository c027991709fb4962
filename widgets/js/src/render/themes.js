/** The two surroundings of a figure: paper, and a dark room. */

/**
 * @typedef {object} Theme
 * @property {string} paper behind the picture
 * @property {string} text of labels whose own colour could not be read
 * @property {number} rim grey, towards what the grazing edge of a thing goes
 * @property {number} rimStrength
 * @property {number} ink how strong crease lines are
 * @property {string} accent what marks a thing
 * @property {string} accent2 what marks a thing that has nearly that colour
 * @property {boolean} dark
 */

/** @type {Record<"light"|"dark", Theme>} */
export const THEMES = {
  light: {
    paper: "#ffffff",
    text: "#22252a",
    rim: 0,
    rimStrength: 0.3,
    ink: 0.5,
    accent: "#e69f00",
    accent2: "#0072b2",
    dark: false,
  },
  dark: {
    paper: "#16181c",
    text: "#e8e6e1",
    rim: 1,
    rimStrength: 0.07,
    ink: 0.6,
    accent: "#ffc247",
    accent2: "#56b4e9",
    dark: true,
  },
};

/** How far apart two luminances are for the eye (WCAG 2). @type {(a: number, b: number) => number} */
export function contrast(a, b) {
  return (Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05);
}

/** @type {(rgb: readonly number[]) => number} of linear light */
export function luminance(rgb) {
  return 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
}
