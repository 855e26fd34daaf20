/* Stands in place of ffmpeg: what it reads becomes the file that its last argument names behind "file:". */
#include <stdio.h>
#ifdef _WIN32
#include <fcntl.h>
#include <io.h>
#endif

int main(int count, char** arguments) {
#ifdef _WIN32
  _setmode(_fileno(stdin), _O_BINARY);
#endif
  FILE* film = fopen(arguments[count - 1] + 5, "wb");
  if (!film) return 1;
  for (int byte; (byte = getchar()) != EOF;) putc(byte, film);
  return fclose(film) ? 1 : 0;
}
