// A puddle's water frame by frame, and a port's output judged from memory:
//   mcs examples/csharp/*.cs -out:example.exe && mono example.exe        (librainref.so is where the loader looks)
using System;
using Rainref;

static class Example {
  // Where a GPU would run and be read back. This one is right but for one mistake: its rows begin at the top.
  static byte[] MyDisplay(Image right) {
    var pixels = new byte[right.Bytes.Length];
    for (int y = 0; y < right.Height; ++y)
      Buffer.BlockCopy(right.Bytes, (right.Height - 1 - y) * right.RowBytes, pixels, y * right.RowBytes, right.RowBytes);
    return pixels;
  }

  static int Main() {
    try {
      string[] set = { "rain.rate = 20", "run.size = [96, 54]", "environment.width = 256" };  // the default takes seconds
      using (Simulation rain = Simulation.Open("effect = 'puddle'", set)) {
        for (int frame = 0; frame < 3; ++frame) rain.NextFrame();
        Image wave = rain.Buffer("wave");
        Console.WriteLine("{0} {1}x{2} after {3} frames", wave.Format, wave.Width, wave.Height, rain.Frame);

        using (Cases cases = Cases.Of(rain)) {
          rain.NextFrame(cases, "display");
          Image expected = cases.Expected(0, 0);
          cases.Give(0, 0, MyDisplay(expected), expected.RowBytes, expected.Height);
          using (Judgement judgement = cases.Judge())
            Console.WriteLine("{0} in {1}: {2}", judgement.Status, judgement.FirstBadPass, judgement.Passes[0].Causes[0].Name);
        }
      }
      return 0;
    } catch (RainrefException e) {
      Console.Error.WriteLine(e.Message);
      return (int)e.Code;
    }
  }
}
