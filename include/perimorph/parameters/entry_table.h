#pragma once

#include <perimorph/parameters/reader.h>

#include <string>
#include <vector>

namespace Perimorph::Parameters
{
  /// The declared entries of a parameter handler, searched by name: what the
  /// readers of files and of command lines share.
  class EntryTable
  {
  public:
    explicit EntryTable(dealii::ParameterHandler &prm);

    bool
    has_section(const std::vector<std::string> &sections) const;

    /// Names of the sections directly inside of @p sections.
    std::vector<std::string>
    section_names(const std::vector<std::string> &sections) const;

    /// The entry, or nullptr.
    const DeclaredEntry *
    find(const std::vector<std::string> &sections,
         const std::string              &name) const;

    /// The end of a message about an entry which @p sections does not have:
    /// where it belongs, or the nearest name.
    std::string
    advice(const std::vector<std::string> &sections,
           const std::string              &name) const;

    /// Sets the value, or adds a message if it does not match the pattern.
    void
    set(const DeclaredEntry       &entry,
        const std::string         &value,
        Base::InputErrorCollector &errors);

  private:
    dealii::ParameterHandler  &prm;
    std::vector<DeclaredEntry> entries;
  };

  /// "section 'A / B'", or "the top level" without sections.
  std::string
  section_title(const std::vector<std::string> &sections);
} // namespace Perimorph::Parameters
