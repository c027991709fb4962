/**
 * The shapes of what travels over the wire (format "reactive4d/1"), and of what the core hands to a screen.
 *
 * Use them as `@typedef {import("./types.js").Snapshot} Snapshot`. The ones from outside ("Wire…") say what a checked
 * message looks like; `manifests.js`, `tracks.js` and `chunks.js` do the checking.
 */

/** 32 hex digits: what an array is, whatever copy of it was sent. @typedef {string} Ref */
/** A number, a truth value, a text, or a short list of numbers.
 * @typedef {number|boolean|string|readonly number[]|null} Value */
/** By parameter name; has no prototype. @typedef {Readonly<Record<string, Value>>} Parameters */
/** JSON lists of numbers, or base64 of little-endian float64. @typedef {number[]|{f64: string}} WireNumbers */
/** `[start, stop)`; null is an infinity. @typedef {[number|null, number|null]} WireInterval */
/** `[start, stop)`. @typedef {readonly [number, number]} Interval */
/** A number, a truth value, or `[operator, ...]`. @typedef {number|boolean|any[]} Tree */

/** See `tracks.js` for what each kind has. @typedef {{kind: string, [name: string]: any}} WireTrack */

/**
 * @typedef {object} WireSegment an answer: what a channel is over a time, for some values of the parameters it read
 * @property {string} channel `name#channel`
 * @property {WireInterval} when
 * @property {Record<string, Value>} [where]
 * @property {WireTrack} [track]
 * @property {string} [error] instead of a track
 * @property {string[]} [blend] parameters between whose stops one may go linearly
 */

/**
 * @typedef {object} WireChunk arrays of one dtype and shape, packed
 * @property {Ref[]} refs
 * @property {"f32"|"u32"} dtype
 * @property {number[]} shape of each: [n, k], or [n]
 * @property {"raw"|"u16"|"u16s"|"plain"} encoding
 * @property {number[]} [lo] of each column; of u16 and u16s
 * @property {number[]} [hi]
 * @property {string|Uint8Array} data deflate-raw, or plain; base64 of it, or the bytes themselves
 */

/**
 * @typedef {object} Ask
 * @property {number} seq
 * @property {number} revision what the asker knows of
 * @property {Parameters} parameters all of them
 * @property {number[]} times
 * @property {string[]} channels
 * @property {boolean} [plays] whether time runs: then the ticks round a time will do
 *
 * @typedef {object} Answer
 * @property {number} seq of the ask
 * @property {number} revision
 * @property {WireSegment[]} segments
 * @property {WireChunk[]} blobs
 *
 * @typedef {object} Stale
 * @property {number} revision
 * @property {[string, number|null, number|null][]} spans channel, start, stop
 */

/**
 * @typedef {object} Transport who answers: a page's own table, a notebook's kernel, a server
 * @property {() => Promise<WireManifest>} open
 * @property {(ask: Ask) => Promise<Answer>} ask
 * @property {(listener: (stale: Stale) => void) => void} onStale
 * @property {(refs: Ref[]) => void} dropped what the viewer no longer has
 * @property {(refs: Ref[]) => Promise<WireChunk[]>} need
 * @property {() => void} close
 * @property {(wish: Wish) => Promise<Uint8Array>} [picture] draws, for who cannot: JPEG
 *
 * @typedef {object} Wish what is to be seen on a picture that somebody else draws
 * @property {number} time
 * @property {Record<string, any>} parameters
 * @property {{position: number[], target: number[], up: number[], fov: number}} camera
 * @property {number[]} size pixels
 * @property {"light"|"dark"} theme
 * @property {boolean} edges
 * @property {boolean} shadows
 * @property {boolean} sharp whether it stands still
 */

/** @typedef {"number"|"integer"|"boolean"|"select"|"color"|"range"|"xy"} ParameterKind */

/**
 * @typedef {object} Parameter
 * @property {string} name
 * @property {ParameterKind} kind
 * @property {string} label
 * @property {string} doc
 * @property {string} unit
 * @property {Value} default
 * @property {[number|null, number|null]|null} bounds
 * @property {number|null} step
 * @property {Value[]|null} options of a select
 * @property {string[]|null} labels of the options
 * @property {Value[]|null} stops the values that the page holds
 * @property {"free"|"stops"|"fixed"} grade
 * @property {string} why it is fixed
 * @property {boolean} hidden
 * @property {boolean} optional null is a value too
 * @property {[number|null, number|null]|null} soft what a slider spans where bounds are open
 * @property {{bounds?: [Tree, Tree], constant?: Tree}|null} depends on other parameters
 *
 * @typedef {object} Handle
 * @property {string} node
 * @property {string[]} parameters
 * @property {string} label
 * @property {"axis"|"plane"|"circle"} kind
 * @property {string[]} axes of the world, in the order of the parameters; none of a circle
 *
 * @typedef {object} Eye a way to look: the default view, the reader's camera
 * @property {number[]} position
 * @property {number[]} target
 * @property {number[]} [up]
 * @property {number} [fov] degrees, vertical
 * @property {number} [near]
 * @property {number} [far]
 *
 * @typedef {object} Options
 * @property {"auto"|"light"|"dark"} theme
 * @property {number|null} height CSS pixels; null: by the width
 * @property {boolean} loop
 * @property {boolean} autoplay
 * @property {boolean} edges
 * @property {"smooth"|"flat"|"wire"} shading
 * @property {boolean} ground
 * @property {boolean} axes
 * @property {boolean} grid
 * @property {boolean} shadows
 * @property {string} playing "time", or a parameter
 *
 * @typedef {object} Manifest what a figure is, before anything is asked; complete, checked and frozen
 * @property {"reactive4d/1"} format
 * @property {string} name
 * @property {string} title
 * @property {string} doc
 * @property {number} revision
 * @property {{start: number, stop: number, rate: number, marks: readonly number[], still: boolean}} times
 * @property {readonly Parameter[]} parameters
 * @property {readonly Handle[]} handles
 * @property {Required<Eye>} view
 * @property {[number[], number[]]} bounds
 * @property {readonly {name: string, kind: string}[]} nodes
 * @property {readonly {name: string, unit: string, format: string}[]} values
 * @property {Point} point where the figure opens
 * @property {Options} options
 * @property {"never"|"instead"|"always"} pictures whether a server draws: for who cannot, or for everybody
 * @property {Cells|null} cells signals that are shown at work beside the picture
 *
 * @typedef {object} Cells boxes, by columns and rows, and who asks whom
 * @property {readonly {name: string, at: number[]}[]} boxes
 * @property {readonly {from: number, to: number, via: number[][]}[]} arrows
 * @property {readonly (readonly string[])[]|null} moves the parameters that were moved for `#cells.0` …; null: live
 *
 * @typedef {{format: string, name: string, [name: string]: any}} WireManifest
 *
 * @typedef {object} PageData what a page carries of one figure
 * @property {WireManifest} manifest
 * @property {WireSegment[]} segments
 * @property {WireChunk[]} chunks
 *
 * @typedef {object} PackedPage the same, where that is shorter
 * @property {WireManifest} manifest
 * @property {{bytes: number, data: string}} segments how long the list is as JSON, and this deflated, in base64
 * @property {WireChunk[]} chunks
 */

/**
 * @typedef {object} Point where a reader is: a bookmark, a link, a step of undo
 * @property {number} time seconds
 * @property {Parameters} parameters all of them
 * @property {Eye|null} [camera] the reader's own; null: the scene's, or the default view
 */

/**
 * @typedef {object} Blob an array that came over the wire; the same object as long as it is the same array
 * @property {Ref} ref
 * @property {Float32Array|Uint32Array} array
 * @property {readonly number[]} shape
 * @property {number} top the largest entry of indices; -1 of none, and of floats
 *
 * @typedef {object} FloatBlob
 * @property {Ref} ref
 * @property {Float32Array} array
 * @property {readonly number[]} shape
 *
 * @typedef {object} IndexBlob
 * @property {Ref} ref
 * @property {Uint32Array} array
 * @property {readonly number[]} shape
 * @property {number} top the largest index; -1 if there is none
 *
 * @typedef {object} Points
 * @property {FloatBlob} a
 * @property {FloatBlob|null} b of the same shape as `a`
 * @property {number} mix from 0 (a) to 1 (b)
 *
 * @typedef {object} Topology indices in range of the points beside it
 * @property {IndexBlob|null} faces (F, 3) render vertices; of a mesh, not null
 * @property {IndexBlob|null} origin (R,) render vertex → point; null: render vertices are the points
 * @property {IndexBlob|null} edges (E, 2) pairs of points
 * @property {IndexBlob|null} lines (K, 2) pairs of points; null: consecutive points
 *
 * @typedef {object} Paints one of the two
 * @property {FloatBlob|null} faces (F, 4) sRGB
 * @property {FloatBlob|null} points (V, 4) sRGB
 *
 * @typedef {object} Settings what else there is of a label, a light, a camera; null where it does not apply
 * @property {string|null} text
 * @property {number|null} height CSS pixels
 * @property {string|null} light_type
 * @property {number|null} intensity
 * @property {number|null} angle degrees
 * @property {number|null} reach metres; null is everywhere
 * @property {boolean|null} shadows
 * @property {number|null} fov degrees
 * @property {number|null} near
 * @property {number|null} far
 * @property {number[]|null} target
 *
 * @typedef {"mesh"|"lines"|"points"|"label"|"light"|"camera"|"none"} Drawn
 *
 * @typedef {object} NodeState one node at one point; the same object as long as nothing about it changes
 * @property {string} name
 * @property {string} kind
 * @property {Drawn} drawn "none" as well if an error keeps it from being drawn
 * @property {boolean} visible
 * @property {readonly number[]} color sRGB and straight alpha
 * @property {Float64Array} matrix (16) row-major, local → world
 * @property {Points|null} points
 * @property {Topology|null} topology
 * @property {Paints|null} paints
 * @property {Settings} settings
 *
 * @typedef {{channel: string, text: string}} Problem
 *
 * @typedef {object} Snapshot all of a figure at one revision and one point; immutable
 * @property {number} revision
 * @property {number} time
 * @property {Parameters} parameters
 * @property {ReadonlyMap<string, NodeState>} nodes in the order of the scene; the same map if none changed
 * @property {ReadonlyMap<string, Value>} values
 * @property {readonly Problem[]} problems
 * @property {readonly (string|null)[]} cells a letter for each box: as time went on, then for each of the moves
 *
 * @typedef {{start: number, stop: number, state: "remembered"|"stale"|"computing"|"missing"}} Span
 */

export {};
