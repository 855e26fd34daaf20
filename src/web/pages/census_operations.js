// Operations of the census page on the library, run in its worker (engine.js).
import {judgePack} from "./ports/census/judge.js";

export const versions = library => ({version: library.text(library.value("rr_version")), golden_generation: library.value("rr_golden_generation")});
export const judge = (library, given) => judgePack(library.module, given);
