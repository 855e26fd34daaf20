// Errors, texts and memory that cross the border between C# and the library.
using System;
using System.Collections.Generic;
using System.Runtime.InteropServices;
using System.Text;

namespace Rainref {

/// What the library says of a call that failed: place, key, expected, found.
public sealed class RainrefException : Exception {
  public readonly rr_result Code;
  public RainrefException(rr_result code, string message) : base(message) { Code = code; }
}

public static class Call {
  /// Throws the library's error. Call it on the thread that made the call, because each thread has an error of its own.
  public static void Check(int result) {
    if (result != 0) throw new RainrefException((rr_result)result, Text.Of(Native.rr_error()));
  }
  public static UIntPtr Size(long size) { return new UIntPtr((ulong)size); }
  /// The struct_bytes of a struct: the library refuses another size.
  public static UIntPtr SizeOf<T>() { return Size(Marshal.SizeOf(typeof(T))); }
}

public static class Text {
  /// The text at this address, which the library keeps; null for a null pointer.
  public static string Of(IntPtr utf8) {
    if (utf8 == IntPtr.Zero) return null;
    int length = 0;
    while (Marshal.ReadByte(utf8, length) != 0) ++length;
    var bytes = new byte[length];
    Marshal.Copy(utf8, bytes, 0, length);
    return Encoding.UTF8.GetString(bytes);
  }
}

/// Texts for members of structs and for lists, which the marshaller does not make. They live until Dispose.
public sealed class Texts : IDisposable {
  readonly List<IntPtr> made = new List<IntPtr>();
  /// The address of a copy; a null pointer for null.
  public IntPtr Add(string text) {
    if (text == null) return IntPtr.Zero;
    byte[] bytes = Encoding.UTF8.GetBytes(text);
    IntPtr at = Allocate(bytes.Length + 1);
    Marshal.Copy(bytes, 0, at, bytes.Length);
    Marshal.WriteByte(at, bytes.Length, 0);
    return at;
  }
  /// The addresses of copies; an empty array for null.
  public IntPtr[] AddAll(string[] texts) { return Array.ConvertAll(texts ?? new string[0], Add); }
  /// The same as an array in the library's memory.
  public IntPtr AddList(string[] texts) {
    IntPtr[] all = AddAll(texts);
    if (all.Length == 0) return IntPtr.Zero;
    IntPtr at = Allocate(all.Length * IntPtr.Size);
    Marshal.Copy(all, 0, at, all.Length);
    return at;
  }
  public void Dispose() {
    foreach (IntPtr at in made) Marshal.FreeHGlobal(at);
    made.Clear();
  }
  IntPtr Allocate(int bytes) {
    IntPtr at = Marshal.AllocHGlobal(bytes);
    made.Add(at);
    return at;
  }
}

/// A copy of an image, a list or a uniform block in one plane, rows without padding. Halves are their codes of 16 bits: C# 7 has no type
/// for them (Unity: Mathf.HalfToFloat, .NET 5: BitConverter.UInt16BitsToHalf of the later versions).
public sealed class Image {
  public readonly string Name, Format;
  public readonly rr_type Type;
  public readonly int Channels, Width, Height, TexelBytes;
  public readonly byte[] Bytes;
  public int RowBytes { get { return Width * TexelBytes; } }

  /// Copies the planes that the library holds apart into one: texel (x, y) begins at y * RowBytes + x * TexelBytes.
  public Image(rr_array from) {
    Name = Text.Of(from.name);
    Format = Text.Of(from.format);
    Type = (rr_type)from.type;
    Channels = from.channels;
    Width = from.width;
    Height = from.height;
    int part = (int)from.texel_bytes, row = (int)from.row_bytes;
    IntPtr[] planes = { from.plane0, from.plane1, from.plane2, from.plane3 };
    TexelBytes = from.planes == 1 ? part : part * Channels;
    Bytes = new byte[Height * RowBytes];
    var line = new byte[Width * part];
    for (int p = 0; p < from.planes; ++p) {
      for (int y = 0; y < Height; ++y) {
        if (line.Length == 0) continue;
        Marshal.Copy(new IntPtr(planes[p].ToInt64() + (long)y * row), line, 0, line.Length);
        for (int x = 0; x < Width; ++x) Buffer.BlockCopy(line, x * part, Bytes, y * RowBytes + x * TexelBytes + p * part, part);
      }
    }
  }
}
}
