// Why a call to an engine ended early.

/// Error of calls that were in progress when cancel() was called.
export class Cancelled extends Error {
  constructor() {
    super("cancelled");
    this.name = "Cancelled";
  }
}
