// SPDX-License-Identifier: Apache-2.0
#ifndef MAP_KEEPER__GRID_FILE_HPP_
#define MAP_KEEPER__GRID_FILE_HPP_

#include <cstdint>
#include <string>
#include <vector>

namespace map_keeper
{

/// A rectangular grid of occupancy values, row by row: -1 unknown, 0 free, 100 occupied.
struct Grid
{
  int width = 0;
  int height = 0;
  std::vector<std::int8_t> cells;
};

/// Write `grid` as a portable grey map; false if the file cannot be written or the grid is empty.
bool write_grid(const std::string & path, const Grid & grid);

/// Share of occupied cells among the known ones, in percent.
int occupied_percent(const Grid & grid);

}  // namespace map_keeper

#endif  // MAP_KEEPER__GRID_FILE_HPP_
