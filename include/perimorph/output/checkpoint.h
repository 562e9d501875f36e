#pragma once

#include <map>
#include <string>
#include <vector>

namespace Perimorph::Output
{
  /// What a run needs to go on later, by names: numbers (exact to the last bit;
  /// integers up to 2^53), arrays of numbers and lists of words. Other rooms
  /// add entries of their own.
  struct Checkpoint
  {
    std::map<std::string, double>                   numbers;
    std::map<std::string, std::vector<double>>      arrays;
    std::map<std::string, std::vector<std::string>> words;
  };

  /// Writes one file: a line of text (format, length and CRC-32 of what
  /// follows), then CBOR (RFC 8949). Aside and renamed, so that a run killed at
  /// any moment leaves the last complete checkpoint.
  /// @throws Base::InputError   the file cannot be written
  void
  write_checkpoint(const std::string &filename, const Checkpoint &checkpoint);

  /// @throws Base::InputError   no such file, not a checkpoint, of another
  ///                            format, or damaged
  Checkpoint
  read_checkpoint(const std::string &filename);
} // namespace Perimorph::Output
