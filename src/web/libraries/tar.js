// Reads tar archives: ustar, pax and GNU, with checksums.
export {createTarDecoder} from "modern-tar";
