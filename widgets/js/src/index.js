/** The viewer of reactive4d. Everything that an adapter, a page or a test may use is exported here. */

export { WireError } from "./core/errors.js";
