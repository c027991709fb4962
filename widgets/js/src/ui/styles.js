/** How it looks: the page of a book, and in it quiet figures. No font and no picture is fetched. */

export { figureStyles } from "./figure-styles.js";
export { pageStyles } from "./page-styles.js";
export { inlineStyles } from "./inline-styles.js";
