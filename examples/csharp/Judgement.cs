// The verdict on a port, and its reports.
using System;
using System.Collections.Generic;
using System.Runtime.InteropServices;

namespace Rainref {

/// A possible cause of a failure; the best comes first.
public sealed class Cause {
  public readonly string Name, Sentence;
  public readonly bool IsLikely;
  /// Lines of the port's shader: "shade.comp:57: vec3 bent = ...".
  public readonly List<string> Lines = new List<string>();
  public Cause(rr_cause from) {
    Name = Text.Of(from.name);
    Sentence = Text.Of(from.sentence);
    IsLikely = from.is_likely != 0;
  }
}
public sealed class PassVerdict {
  public readonly string Pass, Status, Reason;
  public readonly long Elements, Outside;
  public readonly List<Cause> Causes = new List<Cause>();
  public PassVerdict(rr_pass_verdict from) {
    Pass = Text.Of(from.pass);
    Status = Text.Of(from.status);
    Reason = Text.Of(from.reason);
    Elements = from.elements;
    Outside = from.outside;
  }
}

public sealed class Judgement : IDisposable {
  readonly JudgementHandle handle;
  internal Judgement(JudgementHandle made) { handle = made; }
  public void Dispose() { handle.Dispose(); }
  /// What was copied from the library's memory: the collector may not free that before.
  T Kept<T>(T copy) { GC.KeepAlive(this); return copy; }

  /// Judges the files that a port wrote for a pack, like `rainref validate PACK --port PORT`. `progress` gets the runs done and their
  /// number; it returns false to end the judging, which is a RainrefException.
  public static Judgement OfFolder(string pack, string port, string profile = null, string[] passes = null, bool partial = false,
                                   string spirv = null, Func<int, int, bool> progress = null) {
    Exception failure = null;
    rr_progress callback = (user, done, of) => {
      try { return progress(done, of) ? 0 : 1; } catch (Exception e) { failure = e; return 1; }
    };
    using (var texts = new Texts()) {
      var options = new rr_folder_options {
        struct_bytes = Call.SizeOf<rr_folder_options>(), profile = texts.Add(profile), passes = texts.AddList(passes),
        pass_count = Call.Size(passes == null ? 0 : passes.Length), partial = partial ? 1 : 0, spirv = texts.Add(spirv),
        progress = progress == null ? IntPtr.Zero : Marshal.GetFunctionPointerForDelegate(callback)
      };
      JudgementHandle made;
      int result = Native.rr_judge_folder(pack, port, ref options, out made);
      GC.KeepAlive(callback);  // the library calls it until here
      if (failure != null) throw failure;
      Call.Check(result);
      return new Judgement(made);
    }
  }

  rr_verdict Verdict {
    get {
      var verdict = new rr_verdict { struct_bytes = Call.SizeOf<rr_verdict>() };
      Call.Check(Native.rr_get_verdict(handle, ref verdict));
      return verdict;
    }
  }
  /// "PASS", "WARN", "FAIL", "UNTESTED", "DATA" or "NOT JUDGED".
  public string Status { get { return Kept(Text.Of(Verdict.status)); } }
  public string Reason { get { return Kept(Text.Of(Verdict.reason)); } }
  /// "" if there is none.
  public string FirstBadPass { get { return Kept(Text.Of(Verdict.first_bad_pass)); } }

  public List<PassVerdict> Passes {
    get {
      var all = new List<PassVerdict>();
      for (int p = 0, count = (int)Verdict.passes; p < count; ++p) all.Add(PassAt(p));
      return Kept(all);
    }
  }
  PassVerdict PassAt(int p) {
    var found = new rr_pass_verdict { struct_bytes = Call.SizeOf<rr_pass_verdict>() };
    Call.Check(Native.rr_get_pass_verdict(handle, Call.Size(p), ref found));
    var pass = new PassVerdict(found);
    for (int c = 0; c < (int)found.causes; ++c) {
      var raw = new rr_cause { struct_bytes = Call.SizeOf<rr_cause>() };
      Call.Check(Native.rr_get_cause(handle, Call.Size(p), Call.Size(c), ref raw));
      var cause = new Cause(raw);
      for (int l = 0; l < (int)raw.lines; ++l) {
        IntPtr line;
        Call.Check(Native.rr_get_line(handle, Call.Size(p), Call.Size(c), Call.Size(l), out line));
        cause.Lines.Add(Text.Of(line));
      }
      pass.Causes.Add(cause);
    }
    return pass;
  }

  delegate int Reporter(JudgementHandle judgement, out IntPtr text);
  string Report(Reporter report) {
    IntPtr text;
    Call.Check(report(handle, out text));
    return Kept(Text.Of(text));
  }
  public string ReportText { get { return Report(Native.rr_report_text); } }
  public string Json { get { return Report(Native.rr_report_json); } }
  public string Html { get { return Report(Native.rr_report_html); } }
  public string JUnit { get { return Report(Native.rr_report_junit); } }
}
}
