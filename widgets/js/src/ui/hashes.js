/** The part of a page's address behind "#": which figure each piece belongs to. */

/**
 * The pieces of an address that concern one figure, as "key=value" texts with the figure's name in front;
 * pieces without a name belong to it if it is the page's only (or first) figure.
 * @param {string} hash with or without "#"
 * @param {string} name
 * @param {boolean} bare whether pieces without a name are this figure's
 */
export function piecesFor(hash, name, bare) {
  return pieces(hash).filter((piece) => {
    const key = decoded(piece.slice(0, piece.indexOf("=")));
    if (key.startsWith(`${name}.`)) return true;
    return bare && !key.includes(".");
  });
}

/**
 * The same without the figure's name: "t=1.2&length=1.5".
 * @param {string} hash
 * @param {string} name
 * @param {boolean} bare
 */
export function bareFor(hash, name, bare) {
  return piecesFor(hash, name, bare)
    .map((piece) => {
      const at = piece.indexOf("=");
      const key = decoded(piece.slice(0, at));
      return key.startsWith(`${name}.`) ? encodeURIComponent(key.slice(name.length + 1)) + piece.slice(at) : piece;
    })
    .join("&");
}

/**
 * A whole address of several figures; those that say nothing are left out.
 * @param {readonly string[]} texts
 */
export function joined(texts) {
  const full = texts.filter((text) => text !== "");
  return full.length ? `#${full.join("&")}` : "";
}

/** @param {string} hash @returns {string[]} */
function pieces(hash) {
  return hash.replace(/^#/, "").split("&").filter((piece) => piece.indexOf("=") > 0);
}

/** @param {string} text */
function decoded(text) {
  try {
    return decodeURIComponent(text);
  } catch {
    return text; // a stray per cent sign is taken as it stands
  }
}
