"""Loaders: the few lines that every widget of a notebook carries; the viewer itself is fetched once per page.

And the lines that bring to life what a notebook keeps of a figure, which carries the viewer along.
"""

import base64
from functools import lru_cache

from reactive4d_widgets.bundles import UNPACK, packed

__all__ = ["KEEPER", "LOADER", "bundle"]

# The viewer is asked of the kernel, by its hash, once for all widgets of a page: cells that run again bring none along.
_LOAD = """
const KEY = Symbol.for("reactive4d.viewers");
const viewers = (globalThis[KEY] ??= new Map());

function fetched(model, hash) {
  return new Promise((resolve, reject) => {
    const timer = setTimeout(() => done(new Error("the kernel does not answer")), 120000);
    const done = (error, bytes) => {
      clearTimeout(timer);
      model.off("msg:custom", heard);
      if (error) reject(error); else resolve(bytes);
    };
    const heard = (message, buffers) => {
      if (message?.type !== "bundle" || message.hash !== hash) return;
      const part = buffers?.[0];
      done(null, part ?? bytesOf(message.data));
    };
    model.on("msg:custom", heard);
    model.send({ type: "bundle", hash });
  });
}

// What a notebook keeps of a figure carries the viewer along.
function kept(hash) {
  const code = document.querySelector(`[data-r4d-bundle="${hash}"]`)?.textContent;
  return code ? bytesOf(code) : null;
}

async function load(model, hash) {
  return imported(kept(hash) ?? await fetched(model, hash));
}

function viewer(model) {
  const hash = model.get("_viewer");
  if (!viewers.has(hash)) {
    viewers.set(hash, load(model, hash).catch((error) => { viewers.delete(hash); throw error; }));
  }
  return viewers.get(hash);
}

async function render({ model, el }) {
  let end = () => undefined;
  let isOver = false;
  viewer(model).then(({ widget }) => {
    if (!isOver) end = widget({ model, el });
  }).catch((error) => {
    const note = document.createElement("p");
    note.textContent = `This picture stays still (${error.message}).`;
    el.append(note);
  });
  return () => { isOver = true; end(); };
}

export default { render };
"""
LOADER = UNPACK + _LOAD

# In a notebook the widget comes first: what is kept waits until it is clear that there is no kernel to answer.
_KEEP = """
  const KEY = Symbol.for("reactive4d.viewers");
  const viewers = (globalThis[KEY] ??= new Map());
  const place = document.querySelector(`[data-r4d-poster="${name}"]`);
  const code = place?.querySelector("[data-r4d-bundle]");
  const table = place?.querySelector("[data-r4d-table]");
  if (!code || !table) return;
  const hash = code.dataset.r4dBundle;

  async function begin() {
    const pause = new Promise((done) => { setTimeout(done, 500); }); // a kernel that is gone is not waited for
    let viewer = await Promise.race([viewers.get(hash), pause]);
    if (!viewer) {
      viewers.set(hash, imported(bytesOf(code.textContent)).catch((error) => { viewers.delete(hash); throw error; }));
      viewer = await viewers.get(hash);
    }
    viewer.keepsake({ place, data: JSON.parse(table.textContent) });
  }

  const seen = new IntersectionObserver((entries) => {
    if (!entries.some((entry) => entry.isIntersecting)) return;
    seen.disconnect();
    begin().catch((error) => console.error(error));
  }, { rootMargin: "200px" });
  setTimeout(() => seen.observe(place), document.getElementById("jupyter-config-data") ? 4000 : 0);
"""
KEEPER = f"\n((name) => {{{UNPACK}{_KEEP}}})"


@lru_cache(maxsize=1)
def bundle() -> tuple[bytes, str]:
    """The viewer, gzipped, and the SHA-256 of what it was.

    Raises:
        Reactive4dError: it was not built.

    >>> import gzip
    >>> data, digest = bundle()
    >>> len(gzip.decompress(data)) > 100_000, len(digest)
    (True, 64)
    """
    text, digest = packed()
    return base64.b64decode(text), digest
