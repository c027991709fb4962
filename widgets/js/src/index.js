/** The viewer of reactive4d. Everything that an adapter, a page or a test may use is exported here. */

// core: no screen, runs everywhere
export { BlobStore } from "./core/blobs.js";
export { decode as decodeChunk } from "./core/chunks.js";
export { Clock } from "./core/clock.js";
export { conform } from "./core/conformance.js";
export { Emitter } from "./core/emitters.js";
export { WireError } from "./core/errors.js";
export { compileTree, evaluate } from "./core/expressions.js";
export { readManifest } from "./core/manifests.js";
export { decode as decodePoint, encode as encodePoint } from "./core/point.js";
export { Session } from "./core/session.js";
export { ChannelStore } from "./core/store.js";
export { compile } from "./core/tracks.js";

// transports: who answers
export { baked } from "./transports/baked.js";
export { comm } from "./transports/comm.js";
export { socket } from "./transports/socket.js";

// render: pictures
export { Stage } from "./render/stages.js";
export { View } from "./render/views.js";

// the figure, what drives it from the prose, and a page that holds them
export { FigureElement } from "./ui/figure-element.js";
export { CheckElement } from "./inline/check.js";
export { EitherElement } from "./inline/either.js";
export { LinkElement } from "./inline/link.js";
export { NumberElement } from "./inline/number.js";
export { WordElement } from "./inline/word.js";
export { define } from "./adapters/figures.js";
export { start } from "./adapters/page.js";
export { keepsake, widget } from "./adapters/anywidget.js";
export { connect, serve } from "./adapters/trame.js";
export { vue } from "./adapters/vue.js";
export { either, site } from "./adapters/site.js";
