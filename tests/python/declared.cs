// Prints what examples/csharp declares, for test_csharp.py; and, given a scene and a number of frames, hashes what it simulates.
using System;
using System.IO;
using System.Reflection;
using System.Runtime.InteropServices;
using Rainref;

static class Declared {
  static void PrintDeclarations() {
    foreach (Type type in typeof(Native).Assembly.GetTypes()) {
      if (!type.Name.StartsWith("rr_")) continue;
      if (type.IsEnum)
        foreach (string name in Enum.GetNames(type)) Console.WriteLine("constant {0} {1}", name, (int)Enum.Parse(type, name));
      else if (type.IsValueType) {
        Console.WriteLine("struct {0} {1}", type.Name, Marshal.SizeOf(type));
        foreach (FieldInfo field in type.GetFields())
          Console.WriteLine("member {0} {1} {2}", type.Name, field.Name, Marshal.OffsetOf(type, field.Name));
      }
    }
    foreach (MethodInfo method in typeof(Native).GetMethods(BindingFlags.Static | BindingFlags.Public)) {
      string line = "function " + method.Name + " " + method.ReturnType.Name;
      foreach (ParameterInfo parameter in method.GetParameters()) line += " " + parameter.ParameterType.Name;
      Console.WriteLine(line);
    }
  }

  /// The frames, with the state saved and loaded in the middle.
  static void PrintHashes(string scene, int frames) {
    using (Simulation first = Simulation.OpenFile(scene)) {
      for (int frame = 0; frame < frames / 2; ++frame) Console.Write(first.NextFrameHashes());
      var state = new MemoryStream();
      first.Save(state);
      state.Position = 0;
      using (Simulation second = Simulation.OpenFile(scene)) {
        second.Load(state);
        while (second.Frame < frames) Console.Write(second.NextFrameHashes());
      }
    }
  }

  sealed class BrokenStream : MemoryStream {
    public override void Write(byte[] bytes, int offset, int count) { throw new IOException("the disk is full"); }
  }
  static void PrintErrors(string scene) {
    try { Simulation.Open("effect = 'pudle'"); } catch (RainrefException e) { Console.WriteLine("{0}: {1}", e.Code, e.Message); }
    using (Simulation simulation = Simulation.OpenFile(scene)) {
      simulation.NextFrame();
      try { simulation.Save(new BrokenStream()); } catch (IOException e) { Console.WriteLine(e.Message); }
      try { simulation.View("wäve"); } catch (RainrefException e) { Console.WriteLine("{0}: {1}", e.Code, e.Message); }
    }
  }

  /// The verdict on a folder, each run of a pass counted.
  static void PrintVerdict(string pack, string port) {
    int calls = 0;
    using (Judgement judgement = Judgement.OfFolder(pack, port, progress: (done, of) => { ++calls; GC.Collect(); return true; })) {
      Console.WriteLine("{0} {1} {2}", judgement.Status, judgement.Passes.Count, calls > 0);
      Console.Write(judgement.ReportText);
    }
    try { Judgement.OfFolder(pack, port, progress: (done, of) => false); } catch (RainrefException e) { Console.WriteLine(e.Code); }
  }

  static void Main(string[] words) {
    if (words.Length == 0) PrintDeclarations();
    else if (words[0] == "hash") PrintHashes(words[1], int.Parse(words[2]));
    else if (words[0] == "errors") PrintErrors(words[1]);
    else PrintVerdict(words[1], words[2]);
  }
}
