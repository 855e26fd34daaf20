// Types of index.mjs.

/** A failed call. `code` is that of the command line: 2 arguments or scene, 3 files of a pack or port, 4 unreadable, 5 a defect. */
export class RainrefError extends Error {
  code: number;
}

export type Folder = Map<string, Uint8Array>;
export type Status = "PASS" | "WARN" | "FAIL" | "UNTESTED" | "DATA" | "NOT JUDGED";

export interface OpenOptions {
  /** "key=value", as for `rainref run --set`. */
  set?: string[];
  /** Files that the scene names, by their path relative to it. */
  files?: Folder;
  /** Name of the scene in errors. */
  name?: string;
}

export interface SimulationInfo {
  effect: string;
  variant: string;
  /** Frames simulated so far. */
  frame: number;
  /** Frames that the scene asks for. */
  frames: number;
  scene: Record<string, unknown>;
  warnings: string[];
}

export type Plane = Uint8Array | Uint16Array | Float32Array | Uint32Array | Int32Array;
export interface Buffer {
  name: string;
  /** "rg16f"; for records the name of their layout. */
  format: string;
  channels: number;
  width: number;
  height: number;
  /** One with all channels, or one for each channel. Rows from v = 0 on, without padding. Halves are their codes. */
  planes: Plane[];
}
export interface Picture {
  width: number;
  height: number;
  /** RGBA of 8 bits, top row first. */
  data: Uint8ClampedArray;
}

export class Simulation {
  private constructor();
  readonly info: SimulationInfo;
  readonly buffers: string[];
  nextFrame(): void;
  /** Lines "frame pass buffer hash", as `rainref hash` prints them. */
  nextFrameHashes(): string[];
  set(key: string, value: string): void;
  buffer(name: string): Buffer;
  picture(): Picture;
  /** Frees its memory; no other call may follow. */
  close(): void;
}

export interface JudgeOptions {
  /** "vulkan" by default; Rainref.profiles lists them. */
  profile?: string;
  /** All if there is none. */
  passes?: string[];
  /** A pass without files is NOT JUDGED. */
  partial?: boolean;
  /** Each WARN is a FAIL. */
  strict?: boolean;
  exhaustive?: boolean;
  /** bindings.json and the port's SPIR-V: causes then name lines. */
  spirv?: Folder | null;
  /** Called after each run of a pass; false ends the judging. */
  onProgress?: (done: number, of: number) => boolean | void;
  /** What reports call the folders. */
  names?: {pack?: string; port?: string};
}
export interface Judged {
  status: Status;
  text: string;
  json: string;
  html: string;
  junit: string;
}

export class Rainref {
  private constructor();
  readonly version: string;
  readonly goldenGeneration: number;
  readonly effects: string[];
  readonly profiles: string[];
  describe(effect: string): Record<string, unknown>;
  open(toml: string, options?: OpenOptions): Simulation;
  judge(pack: Folder, port: Folder, options?: JudgeOptions): Judged;
}

/** `judge: false` loads the simulator alone, which is half as large and reads no pictures in files. */
export function loadRainref(options?: {judge?: boolean}): Promise<Rainref>;
