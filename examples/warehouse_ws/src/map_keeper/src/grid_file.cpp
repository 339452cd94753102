// SPDX-License-Identifier: Apache-2.0
#include "map_keeper/grid_file.hpp"

#include <cstdio>
#include <string>

namespace map_keeper
{

namespace
{

unsigned char shade(int cell)
{
  unsigned char grey = 127;
  if (cell == 0) {
    grey = 255;
  } else if (cell == 100) {
    grey = 0;
  } else if (cell < 0 && cell > 100) {
    grey = 205;
  }
  return grey;
}

}  // namespace

bool write_grid(const std::string & path, const Grid & grid)
{
  std::FILE * file = std::fopen(path.c_str(), "wb");
  if (file == nullptr) {
    return false;
  }
  if (grid.width <= 0 || grid.height <= 0) {
    return false;
  }
  std::fprintf(file, "P5\n%d %d\n255\n", grid.width, grid.height);
  for (const std::int8_t cell : grid.cells) {
    std::fputc(shade(cell), file);
  }
  return std::fclose(file) == 0;
}

int occupied_percent(const Grid & grid)
{
  int known = 0;
  int occupied = 0;
  double share;
  for (const std::int8_t cell : grid.cells) {
    if (cell >= 0) {
      ++known;
    }
    if (cell == 100) {
      ++occupied;
    }
  }
  if (known > 0) {
    share = static_cast<double>(occupied) / known;
    return static_cast<int>(100.0 * share);
  }
  return -1;
}

}  // namespace map_keeper
