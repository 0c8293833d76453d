/* Preloaded, it makes German the locale of a program, as a library may that the program loads. */
#include <locale.h>

__attribute__((constructor)) static void choose(void) {
  setlocale(LC_ALL, "de_DE.UTF-8");
}
