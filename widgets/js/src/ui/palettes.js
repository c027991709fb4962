/** The colours of figures and pages, light and dark: Okabe and Ito's blue and orange, on paper and at night. */

export const LIGHT = `
  --paper: #fdfcf9; --plate: #ffffff; --raised: #ffffff; --wash: #f3f0e9; --line: #d8d3c8;
  --ink: #1f1d1a; --soft: #5d5952; --accent: #0067a8; --on-accent: #ffffff; --grip: #c25500; --alarm: #a8320a;
  --shade: rgb(40 34 20 / 14%); color-scheme: light;`;

export const DARK = `
  --paper: #16181c; --plate: #16181c; --raised: #26282c; --wash: #212326; --line: #3b3c3f;
  --ink: #e6e2d9; --soft: #a8a298; --accent: #62b6f2; --on-accent: #0b1722; --grip: #f0a73c; --alarm: #ff9a6b;
  --shade: rgb(0 0 0 / 45%); color-scheme: dark;`;
