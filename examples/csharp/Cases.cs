// Runs of passes with their inputs and outputs, and what a port gives for them.
using System;
using System.Runtime.InteropServices;

namespace Rainref {

/// A run of a pass.
public sealed class Case {
  public readonly string Id, Pass, Formula;
  public readonly int Frame, Step, Level, Inputs, Outputs;
  public readonly float Time, TimeStep;
  public Case(rr_case_info from) {
    Id = Text.Of(from.id);
    Pass = Text.Of(from.pass);
    Formula = Text.Of(from.formula);
    Frame = from.frame;
    Step = from.step;
    Level = from.level;
    Inputs = (int)from.inputs;
    Outputs = (int)from.outputs;
    Time = from.time;
    TimeStep = from.dt;
  }
}

public sealed class Cases : IDisposable {
  internal readonly CasesHandle Handle;
  Cases(CasesHandle handle) { Handle = handle; }
  public void Dispose() { Handle.Dispose(); }
  /// What was copied from the library's memory: the collector may not free that before.
  T Kept<T>(T copy) { GC.KeepAlive(this); return copy; }

  /// None yet: Simulation.NextFrame(cases, passes) adds to them.
  public static Cases Of(Simulation simulation) {
    CasesHandle handle;
    Call.Check(Native.rr_cases_of_simulation(simulation.Handle, out handle));
    return new Cases(handle);
  }
  /// Those of a pack; of all passes if none is named.
  public static Cases OfPack(string folder, params string[] passes) {
    using (var texts = new Texts()) {
      CasesHandle handle;
      Call.Check(Native.rr_cases_of_pack(folder, texts.AddAll(passes), Call.Size(passes.Length), out handle));
      return new Cases(handle);
    }
  }

  public int Count { get { return (int)Native.rr_case_count(Handle); } }
  public Case this[int index] {
    get {
      var info = new rr_case_info { struct_bytes = Call.SizeOf<rr_case_info>() };
      Call.Check(Native.rr_get_case(Handle, Call.Size(index), ref info));
      return Kept(new Case(info));
    }
  }

  delegate int Getter(ref rr_array array);
  Image Copied(Getter get) {
    var array = new rr_array { struct_bytes = Call.SizeOf<rr_array>() };
    Call.Check(get(ref array));
    return Kept(new Image(array));
  }
  public Image Uniforms(int index) { return Copied((ref rr_array a) => Native.rr_get_uniforms(Handle, Call.Size(index), ref a)); }
  public Image Input(int index, int input, int level = 0) {
    return Copied((ref rr_array a) => Native.rr_get_input(Handle, Call.Size(index), Call.Size(input), level, ref a));
  }
  public Image Expected(int index, int output) {
    return Copied((ref rr_array a) => Native.rr_get_expected(Handle, Call.Size(index), Call.Size(output), ref a));
  }
  /// "envelope", "bits", "keyed" or "input_only".
  public string JudgedBy(int index, int output) { return Kept(Text.Of(Native.rr_get_judge(Handle, Call.Size(index), Call.Size(output)))); }

  /// Gives a port's result; it is copied. `count` is the height of an image, or the number of records.
  public void Give(int index, int output, byte[] data, int rowBytes, int count) {
    if ((long)rowBytes * count > data.Length)
      throw new ArgumentException(string.Format("expected {0} rows of {1} bytes, found {2} bytes", count, rowBytes, data.Length));
    Call.Check(Native.rr_give(Handle, Call.Size(index), Call.Size(output), data, Call.Size(rowBytes), Call.Size(count)));
  }
  /// The same for an image of another type or with more channels (docs/dumps.md).
  public void Give(int index, int output, byte[] data, rr_type type, int channels, int width, int height) {
    int texel = data.Length / Math.Max(width * height, 1);
    GCHandle pinned = GCHandle.Alloc(data, GCHandleType.Pinned);
    try {
      var image = new rr_array {
        struct_bytes = Call.SizeOf<rr_array>(), type = (int)type, channels = channels, width = width, height = height, levels = 1,
        planes = 1, texel_bytes = Call.Size(texel), row_bytes = Call.Size((long)texel * width), plane0 = pinned.AddrOfPinnedObject()
      };
      Call.Check(Native.rr_give_image(Handle, Call.Size(index), Call.Size(output), ref image));
    } finally { pinned.Free(); }
  }

  /// Judges all that was given. `spirv`: the folder of the port's shaders, so that causes get lines.
  public Judgement Judge(string profile = null, string port = null, bool strict = false, string spirv = null) {
    using (var texts = new Texts()) {
      var options = new rr_judge_options {
        struct_bytes = Call.SizeOf<rr_judge_options>(), profile = texts.Add(profile), port = texts.Add(port), strict = strict ? 1 : 0,
        spirv = texts.Add(spirv)
      };
      JudgementHandle handle;
      Call.Check(Native.rr_judge(Handle, ref options, out handle));
      return new Judgement(handle);
    }
  }
}
}
