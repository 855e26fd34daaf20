// A scene that runs: its frames, buffers, picture and state.
using System;
using System.Collections.Generic;
using System.IO;
using System.Runtime.InteropServices;

namespace Rainref {

/// One thread at a time may use it. A failure is a RainrefException.
public sealed class Simulation : IDisposable {
  internal readonly SimulationHandle Handle;
  Simulation(SimulationHandle handle) { Handle = handle; }
  public void Dispose() { Handle.Dispose(); }
  /// What was copied from the library's memory: the collector may not free that before.
  T Kept<T>(T copy) { GC.KeepAlive(this); return copy; }

  delegate int Opener(string scene, ref rr_open_options options, out SimulationHandle made);
  static Simulation Opened(Opener open, string scene, string file, string[] set, int threads) {
    using (var texts = new Texts()) {
      var options = new rr_open_options {
        struct_bytes = Call.SizeOf<rr_open_options>(), file = texts.Add(file), set = texts.AddList(set),
        set_count = Call.Size(set == null ? 0 : set.Length), threads = threads
      };
      SimulationHandle handle;
      Call.Check(open(scene, ref options, out handle));
      return new Simulation(handle);
    }
  }
  /// Opens the text of a scene. `set` holds "key=value"; `file` names the text in errors and gives the folder of its files.
  public static Simulation Open(string toml, string[] set = null, string file = null, int threads = 0) {
    return Opened(Native.rr_open, toml, file, set, threads);
  }
  /// Opens a scene file, or a bundled scene such as "puddle/default.toml".
  public static Simulation OpenFile(string path, string[] set = null, int threads = 0) {
    return Opened(Native.rr_open_file, path, null, set, threads);
  }

  rr_simulation_info Info {
    get {
      var info = new rr_simulation_info { struct_bytes = Call.SizeOf<rr_simulation_info>() };
      Call.Check(Native.rr_get_info(Handle, ref info));
      return info;
    }
  }
  public string Effect { get { return Kept(Text.Of(Info.effect)); } }
  public string Variant { get { return Kept(Text.Of(Info.variant)); } }
  /// Frames simulated so far.
  public int Frame { get { return Info.frame; } }
  /// Frames that the scene asks for.
  public int Frames { get { return Info.frames; } }
  public string SceneJson { get { return Kept(Text.Of(Info.scene_json)); } }
  public List<string> Warnings { get { return Kept(All(i => Native.rr_warning(Handle, i))); } }
  public List<string> Buffers { get { return Kept(All(i => Native.rr_buffer_name(Handle, i))); } }
  static List<string> All(Func<UIntPtr, IntPtr> at) {
    var found = new List<string>();
    for (string text; (text = Text.Of(at(Call.Size(found.Count)))) != null;) found.Add(text);
    return found;
  }

  public void Simulate() { Call.Check(Native.rr_simulate(Handle)); }
  public void Render() { Call.Check(Native.rr_render(Handle)); }
  public void NextFrame() { Call.Check(Native.rr_next_frame(Handle)); }
  /// The lines of `rainref hash` for this frame.
  public string NextFrameHashes() {
    IntPtr lines;
    Call.Check(Native.rr_next_frame_hashes(Handle, out lines));
    return Kept(Text.Of(lines));
  }
  /// From the next frame on.
  public void Set(string key, string value) { Call.Check(Native.rr_set(Handle, key, value)); }
  public void WritePng(string path) { Call.Check(Native.rr_write_png(Handle, path)); }
  public void WriteExr(string path) { Call.Check(Native.rr_write_exr(Handle, path)); }

  /// A film of the next frames (0: the rest of the scene's) whose number `every` divides: .mp4, .webm or .gif, made by ffmpeg.
  public void Film(string path, int frames = 0, int every = 1) {
    Call.Check(Native.rr_film(Handle, path, frames, every, null, IntPtr.Zero));
  }
  /// A pack of the scene from its first frame on; returns sentences about it. `seed`: a whole number, "random", or null for the scene's.
  public string WritePack(string folder, string seed = null, params string[] passes) {
    using (var texts = new Texts()) {
      var options = new rr_pack_options {
        struct_bytes = Call.SizeOf<rr_pack_options>(), passes = texts.AddList(passes), pass_count = Call.Size(passes.Length),
        seed = texts.Add(seed)
      };
      IntPtr notes;
      Call.Check(Native.rr_write_pack(Handle, folder, ref options, out notes));
      return Kept(Text.Of(notes));
    }
  }

  /// A buffer where the library holds it, without a copy: valid until the simulation changes or is disposed of.
  public rr_array View(string buffer) {
    var array = new rr_array { struct_bytes = Call.SizeOf<rr_array>() };
    Call.Check(Native.rr_get_buffer(Handle, buffer, ref array));
    return array;
  }
  public Image Buffer(string name) {
    return Kept(new Image(View(name)));
  }
  /// The last picture; row 0 is its bottom row.
  public Image Picture() {
    var array = new rr_array { struct_bytes = Call.SizeOf<rr_array>() };
    Call.Check(Native.rr_get_picture(Handle, ref array));
    return Kept(new Image(array));
  }

  /// Writes the state. An exception of the stream is thrown again here, because none may pass through the library.
  public void Save(Stream to) {
    Exception failure = null;
    rr_write write = (user, bytes, count) => {
      try {
        var block = new byte[(int)count];
        Marshal.Copy(bytes, block, 0, block.Length);
        to.Write(block, 0, block.Length);
        return 0;
      } catch (Exception e) { failure = e; return 1; }
    };
    int result = Native.rr_save(Handle, write, IntPtr.Zero);
    GC.KeepAlive(write);  // the library calls it until here
    if (failure != null) throw failure;
    Call.Check(result);
  }
  /// Loads all of the stream as the state of this scene.
  public void Load(Stream from) {
    Exception failure = null;
    rr_read read = (user, bytes, count) => {
      try {
        var block = new byte[(int)Math.Min((ulong)count, 1u << 20)];
        int got = from.Read(block, 0, block.Length);
        Marshal.Copy(block, 0, bytes, got);
        return got;
      } catch (Exception e) { failure = e; return -1; }
    };
    int result = Native.rr_load(Handle, read, IntPtr.Zero);
    GC.KeepAlive(read);
    if (failure != null) throw failure;
    Call.Check(result);
  }

  /// Runs the next frame, and adds the runs of these passes to `cases`; all passes if none is named.
  public void NextFrame(Cases cases, params string[] passes) {
    using (var texts = new Texts())
      Call.Check(Native.rr_next_frame_cases(Handle, texts.AddAll(passes), Call.Size(passes.Length), cases.Handle));
  }
}
}
