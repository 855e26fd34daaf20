// rainref.h for C#: every struct and function, with its name in C. The other files of this folder make objects from them.
//
// C# 7, for Mono, Unity and .NET. size_t is UIntPtr. A function returns a text as an IntPtr, which Text.Of reads. A struct begins with its
// size (Call.SizeOf). The comments of include/rainref.h say what each function does.
using System;
using System.Runtime.InteropServices;

namespace Rainref {

public enum rr_result { RR_OK = 0, RR_USAGE = 2, RR_FILES = 3, RR_IO = 4, RR_INTERNAL = 5 }
public enum rr_type { RR_UNORM8 = 1, RR_SRGB8, RR_FLOAT16, RR_FLOAT32, RR_UINT32, RR_INT32, RR_RECORDS }

[UnmanagedFunctionPointer(CallingConvention.Cdecl)]
public delegate int rr_write(IntPtr user, IntPtr bytes, UIntPtr count);
[UnmanagedFunctionPointer(CallingConvention.Cdecl)]
public delegate long rr_read(IntPtr user, IntPtr bytes, UIntPtr count);
[UnmanagedFunctionPointer(CallingConvention.Cdecl)]
public delegate int rr_progress(IntPtr user, int done, int of);

[StructLayout(LayoutKind.Sequential)] public struct rr_open_options {
  public UIntPtr struct_bytes;
  public IntPtr file, set;
  public UIntPtr set_count;
  public int threads;
}
[StructLayout(LayoutKind.Sequential)] public struct rr_simulation_info {
  public UIntPtr struct_bytes;
  public IntPtr effect, variant;
  public int frame, frames;
  public UIntPtr buffers, warnings;
  public IntPtr scene_json;
}
[StructLayout(LayoutKind.Sequential)] public struct rr_array {
  public UIntPtr struct_bytes;
  public IntPtr name, format;
  public int type, channels, width, height, levels, planes;
  public UIntPtr texel_bytes, row_bytes;
  public IntPtr plane0, plane1, plane2, plane3, layout;
}
[StructLayout(LayoutKind.Sequential)] public struct rr_layout_info {
  public UIntPtr struct_bytes;
  public IntPtr name;
  public UIntPtr bytes, members;
}
[StructLayout(LayoutKind.Sequential)] public struct rr_member {
  public UIntPtr struct_bytes;
  public IntPtr name, unit, sentence;
  public int type, components;
  public UIntPtr offset;
  public double low, high;
}
[StructLayout(LayoutKind.Sequential)] public struct rr_case_info {
  public UIntPtr struct_bytes;
  public IntPtr id, effect, variant, pass, formula;
  public int frame, step, level;
  public float time, dt;
  public UIntPtr inputs, outputs;
}
[StructLayout(LayoutKind.Sequential)] public struct rr_sampling {
  public UIntPtr struct_bytes;
  public IntPtr filter, mip_filter, address_u, address_v;
  public float border0, border1, border2, border3;
}
[StructLayout(LayoutKind.Sequential)] public struct rr_pack_options {
  public UIntPtr struct_bytes;
  public IntPtr frames;
  public UIntPtr frame_count;
  public IntPtr passes;
  public UIntPtr pass_count;
  public IntPtr seed, progress, user;
}
[StructLayout(LayoutKind.Sequential)] public struct rr_judge_options {
  public UIntPtr struct_bytes;
  public IntPtr profile, port, half;
  public int threads, strict, exhaustive;
  public IntPtr spirv;
}
[StructLayout(LayoutKind.Sequential)] public struct rr_folder_options {
  public UIntPtr struct_bytes;
  public IntPtr profile, passes;
  public UIntPtr pass_count;
  public int partial, threads;
  public IntPtr progress, user;
  public int strict, exhaustive;
  public IntPtr spirv;
}
[StructLayout(LayoutKind.Sequential)] public struct rr_verdict {
  public UIntPtr struct_bytes;
  public IntPtr status, reason, first_bad_pass, profile;
  public UIntPtr passes;
}
[StructLayout(LayoutKind.Sequential)] public struct rr_pass_verdict {
  public UIntPtr struct_bytes;
  public IntPtr pass, formula, status, reason, where;
  public long cases, elements, outside, differing, vacuous;
  public UIntPtr causes, worst;
  public long sampled;
}
[StructLayout(LayoutKind.Sequential)] public struct rr_cause {
  public UIntPtr struct_bytes;
  public IntPtr name, sentence;
  public long explained, of, inside;
  public int is_likely;
  public UIntPtr lines;
}
[StructLayout(LayoutKind.Sequential)] public struct rr_failure {
  public UIntPtr struct_bytes;
  public IntPtr case_id, output, field;
  public int x, y, channel, is_a_number;
  public double got, low, high, expected;
  public IntPtr text;
}

/// A handle of the library. The garbage collector frees it if nobody disposes of it.
public abstract class Handle : SafeHandle {
  protected Handle() : base(IntPtr.Zero, true) {}
  public override bool IsInvalid { get { return handle == IntPtr.Zero; } }
}
public sealed class SimulationHandle : Handle {
  protected override bool ReleaseHandle() { Native.rr_close(handle); return true; }
}
public sealed class CasesHandle : Handle {
  protected override bool ReleaseHandle() { Native.rr_free_cases(handle); return true; }
}
public sealed class JudgementHandle : Handle {
  protected override bool ReleaseHandle() { Native.rr_free_judgement(handle); return true; }
}

/// The functions. They take a text as a string.
public static class Native {
  /// librainref.so on Linux, rainref.dll on Windows.
  const string Library = "rainref";
  const CallingConvention C = CallingConvention.Cdecl;
  const UnmanagedType Utf8 = UnmanagedType.LPUTF8Str;

  [DllImport(Library, CallingConvention = C)] public static extern IntPtr rr_error();
  [DllImport(Library, CallingConvention = C)] public static extern IntPtr rr_version();
  [DllImport(Library, CallingConvention = C)] public static extern uint rr_golden_generation();
  [DllImport(Library, CallingConvention = C)] public static extern IntPtr rr_effect_name(UIntPtr index);
  [DllImport(Library, CallingConvention = C)] public static extern IntPtr rr_profile_name(UIntPtr index);
  [DllImport(Library, CallingConvention = C)] public static extern int rr_describe([MarshalAs(Utf8)] string effect, out IntPtr json);

  [DllImport(Library, CallingConvention = C)] public static extern int rr_keep_images([MarshalAs(Utf8)] string folder);
  [DllImport(Library, CallingConvention = C)] public static extern int rr_open([MarshalAs(Utf8)] string toml, ref rr_open_options options, out SimulationHandle simulation);
  [DllImport(Library, CallingConvention = C)] public static extern int rr_open_file([MarshalAs(Utf8)] string path, ref rr_open_options options, out SimulationHandle simulation);
  [DllImport(Library, CallingConvention = C)] public static extern void rr_close(IntPtr simulation);
  [DllImport(Library, CallingConvention = C)] public static extern int rr_get_info(SimulationHandle simulation, ref rr_simulation_info info);
  [DllImport(Library, CallingConvention = C)] public static extern IntPtr rr_warning(SimulationHandle simulation, UIntPtr index);
  [DllImport(Library, CallingConvention = C)] public static extern int rr_simulate(SimulationHandle simulation);
  [DllImport(Library, CallingConvention = C)] public static extern int rr_render(SimulationHandle simulation);
  [DllImport(Library, CallingConvention = C)] public static extern int rr_next_frame(SimulationHandle simulation);
  [DllImport(Library, CallingConvention = C)] public static extern int rr_next_frame_hashes(SimulationHandle simulation, out IntPtr lines);
  [DllImport(Library, CallingConvention = C)] public static extern int rr_write_png(SimulationHandle simulation, [MarshalAs(Utf8)] string path);
  [DllImport(Library, CallingConvention = C)] public static extern int rr_write_exr(SimulationHandle simulation, [MarshalAs(Utf8)] string path);
  [DllImport(Library, CallingConvention = C)] public static extern int rr_save(SimulationHandle simulation, rr_write write, IntPtr user);
  [DllImport(Library, CallingConvention = C)] public static extern int rr_load(SimulationHandle simulation, rr_read read, IntPtr user);
  [DllImport(Library, CallingConvention = C)] public static extern int rr_set(SimulationHandle simulation, [MarshalAs(Utf8)] string key, [MarshalAs(Utf8)] string value);

  [DllImport(Library, CallingConvention = C)] public static extern int rr_get_layout(IntPtr layout, ref rr_layout_info info);
  [DllImport(Library, CallingConvention = C)] public static extern int rr_get_member(IntPtr layout, UIntPtr index, ref rr_member member);
  [DllImport(Library, CallingConvention = C)] public static extern IntPtr rr_buffer_name(SimulationHandle simulation, UIntPtr index);
  [DllImport(Library, CallingConvention = C)] public static extern int rr_get_buffer(SimulationHandle simulation, [MarshalAs(Utf8)] string name, ref rr_array buffer);
  [DllImport(Library, CallingConvention = C)] public static extern int rr_get_picture(SimulationHandle simulation, ref rr_array picture);

  [DllImport(Library, CallingConvention = C)] public static extern int rr_cases_of_simulation(SimulationHandle simulation, out CasesHandle cases);
  [DllImport(Library, CallingConvention = C)] public static extern int rr_next_frame_cases(SimulationHandle simulation, IntPtr[] passes, UIntPtr pass_count, CasesHandle cases);
  [DllImport(Library, CallingConvention = C)] public static extern int rr_cases_of_pack([MarshalAs(Utf8)] string folder, IntPtr[] passes, UIntPtr pass_count, out CasesHandle cases);
  [DllImport(Library, CallingConvention = C)] public static extern void rr_free_cases(IntPtr cases);
  [DllImport(Library, CallingConvention = C)] public static extern UIntPtr rr_case_count(CasesHandle cases);
  [DllImport(Library, CallingConvention = C)] public static extern int rr_get_case(CasesHandle cases, UIntPtr index, ref rr_case_info info);
  [DllImport(Library, CallingConvention = C)] public static extern int rr_get_uniforms(CasesHandle cases, UIntPtr index, ref rr_array block);
  [DllImport(Library, CallingConvention = C)] public static extern int rr_get_input(CasesHandle cases, UIntPtr index, UIntPtr input, int level, ref rr_array array);
  [DllImport(Library, CallingConvention = C)] public static extern int rr_get_sampling(CasesHandle cases, UIntPtr index, UIntPtr input, ref rr_sampling sampling);
  [DllImport(Library, CallingConvention = C)] public static extern int rr_get_expected(CasesHandle cases, UIntPtr index, UIntPtr output, ref rr_array array);
  [DllImport(Library, CallingConvention = C)] public static extern IntPtr rr_get_judge(CasesHandle cases, UIntPtr index, UIntPtr output);
  [DllImport(Library, CallingConvention = C)] public static extern int rr_give(CasesHandle cases, UIntPtr index, UIntPtr output, byte[] data, UIntPtr row_bytes, UIntPtr count);
  [DllImport(Library, CallingConvention = C)] public static extern int rr_give_image(CasesHandle cases, UIntPtr index, UIntPtr output, ref rr_array image);

  [DllImport(Library, CallingConvention = C)] public static extern int rr_write_pack(SimulationHandle simulation, [MarshalAs(Utf8)] string folder, ref rr_pack_options options, out IntPtr notes);
  [DllImport(Library, CallingConvention = C)] public static extern int rr_film(SimulationHandle simulation, [MarshalAs(Utf8)] string path, int frames, int every, rr_progress progress, IntPtr user);

  [DllImport(Library, CallingConvention = C)] public static extern int rr_judge(CasesHandle cases, ref rr_judge_options options, out JudgementHandle judgement);
  [DllImport(Library, CallingConvention = C)] public static extern int rr_judge_folder([MarshalAs(Utf8)] string pack, [MarshalAs(Utf8)] string port, ref rr_folder_options options, out JudgementHandle judgement);
  [DllImport(Library, CallingConvention = C)] public static extern void rr_free_judgement(IntPtr judgement);
  [DllImport(Library, CallingConvention = C)] public static extern int rr_get_verdict(JudgementHandle judgement, ref rr_verdict verdict);
  [DllImport(Library, CallingConvention = C)] public static extern int rr_get_pass_verdict(JudgementHandle judgement, UIntPtr pass, ref rr_pass_verdict verdict);
  [DllImport(Library, CallingConvention = C)] public static extern int rr_get_cause(JudgementHandle judgement, UIntPtr pass, UIntPtr index, ref rr_cause cause);
  [DllImport(Library, CallingConvention = C)] public static extern int rr_get_line(JudgementHandle judgement, UIntPtr pass, UIntPtr cause, UIntPtr index, out IntPtr line);
  [DllImport(Library, CallingConvention = C)] public static extern int rr_get_failure(JudgementHandle judgement, UIntPtr pass, UIntPtr index, ref rr_failure failure);
  [DllImport(Library, CallingConvention = C)] public static extern int rr_report_text(JudgementHandle judgement, out IntPtr text);
  [DllImport(Library, CallingConvention = C)] public static extern int rr_report_json(JudgementHandle judgement, out IntPtr json);
  [DllImport(Library, CallingConvention = C)] public static extern int rr_report_html(JudgementHandle judgement, out IntPtr html);
  [DllImport(Library, CallingConvention = C)] public static extern int rr_report_junit(JudgementHandle judgement, out IntPtr junit);
}
}
