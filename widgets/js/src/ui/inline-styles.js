/** Numbers, links and words in the prose that drive a figure: they stay part of the sentence. */

export const inlineStyles = `
:host { --r4d-inline: var(--accent, #0067a8); --r4d-wash: color-mix(in srgb, var(--r4d-inline) 12%, transparent); }
:focus-visible { outline: 2px solid var(--r4d-inline); outline-offset: 2px; border-radius: 2px; }
.number, .choice, .word {
  color: var(--r4d-inline); cursor: pointer; font: inherit; border-radius: 2px;
  text-decoration: underline; text-decoration-thickness: 1px; text-underline-offset: 0.2em;
}
.number {
  font-variant-numeric: lining-nums tabular-nums; white-space: nowrap; cursor: ew-resize; touch-action: pan-y;
  user-select: none; -webkit-user-select: none; text-decoration-style: dashed;
}
.number:hover, .number[data-held], .word:hover, .word[aria-pressed="true"], .word:focus-visible {
  background: var(--r4d-wash); box-shadow: 0 0 0 0.15em var(--r4d-wash);
}
.number[aria-disabled="true"] { color: inherit; cursor: help; text-decoration-style: dotted; }
.value { font-variant-numeric: lining-nums tabular-nums; white-space: nowrap; }
.word { text-decoration-style: dotted; text-decoration-thickness: 2px; color: inherit;
  text-decoration-color: var(--r4d-inline); }
.check { display: inline-flex; align-items: center; gap: 0.5em; color: var(--soft, GrayText); }
.check .mark { width: 0.7em; height: 0.7em; border: 2px solid currentcolor; border-radius: 50%; }
.check[data-done] { color: var(--ink, CanvasText); }
.check .mark { box-sizing: border-box; }
.check[data-done] .mark { background: var(--r4d-inline); border-color: var(--r4d-inline); }
a { color: var(--r4d-inline); text-decoration-thickness: 1px; text-underline-offset: 0.18em; }
input.typing {
  font: inherit; font-variant-numeric: lining-nums tabular-nums; color: inherit; background: var(--raised, Field);
  border: 0; border-radius: 2px; padding: 0 0.2em; margin: 0; width: calc(var(--digits, 5) * 1ch + 1em);
  outline: 2px solid var(--r4d-inline);
}
select.choice {
  appearance: none; background: none; border: 0; padding: 0; text-decoration-style: dashed;
  field-sizing: content; max-width: 100%;
}
select.choice option { color: FieldText; background: Field; }
@media (pointer: coarse) {
  .number, .choice, .word { padding-block: 0.3em; }
}
@media (forced-colors: active) {
  .number, .choice, .word { color: LinkText; }
  :focus-visible { outline-color: Highlight; }
}
@media print {
  .number, .choice, .word, a { color: inherit; text-decoration: none; background: none; box-shadow: none; }
}
`;
