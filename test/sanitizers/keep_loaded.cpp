// SPDX-License-Identifier: BSD-3-Clause
/** \file
 * Preloaded for programs under LeakSanitizer: libraries stay loaded until the process ends.
 * What the globals of an OpenGL driver point to is reported as leaked once the driver is
 * unloaded, by addresses that belong to nothing.
 */
extern "C" int dlclose(void* /*library*/)
{
  return 0;
}
