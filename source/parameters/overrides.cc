#include <perimorph/base/name_help.h>
#include <perimorph/parameters/entry_table.h>
#include <perimorph/parameters/overrides.h>
#include <perimorph/parameters/text_tools.h>

#include <cstddef>

namespace Perimorph::Parameters
{
  void
  apply_overrides(const std::vector<std::string> &overrides,
                  dealii::ParameterHandler       &prm,
                  Base::InputErrorCollector      &errors)
  {
    EntryTable table(prm);
    for (const std::string &override_text : overrides)
      {
        const std::string        place  = "--set '" + override_text + "'";
        const std::size_t        equals = override_text.find('=');
        std::vector<std::string> names =
          split_top_level(override_text.substr(0, equals), '/');
        if (equals == std::string::npos || names.empty())
          {
            errors.add(place + "\n  found no " +
                       (names.empty() ? "entry before '='" : "'='") +
                       "; allowed: --set \"Section/entry=value\"");
            continue;
          }
        for (std::string &name : names)
          name = condense_blanks(name);
        const std::string name = names.back();
        names.pop_back();
        if (!table.has_section(names))
          {
            // the first unknown section and the names beside it
            std::vector<std::string> known;
            while (table.has_section(known) &&
                   table.has_section(
                     {names.begin(), names.begin() + known.size() + 1}))
              known.push_back(names[known.size()]);
            errors.add(place + ": section '" + names[known.size()] +
                       "' is not known" +
                       Base::did_you_mean(names[known.size()],
                                          table.section_names(known)));
            continue;
          }
        const DeclaredEntry *entry = table.find(names, name);
        if (entry == nullptr)
          {
            errors.add(place + ": entry '" + name + "' is not known in " +
                       section_title(names) + table.advice(names, name));
            continue;
          }
        errors.remember_origin(entry->path(), "--set");
        table.set(*entry, trim(override_text.substr(equals + 1)), errors);
      }
  }
} // namespace Perimorph::Parameters
