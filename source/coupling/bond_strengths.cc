#include <perimorph/coupling/bond_strengths.h>

#include <algorithm>
#include <limits>

namespace Perimorph::Coupling
{
  template <int dim>
  double
  load_factor_by_strength(const std::array<unsigned int, 2> &nodes,
                          const ParticleStates              &states,
                          const BodyMaterials<dim>          &materials,
                          const StrengthTable               &table,
                          const Damage::BreakingRule        &rule,
                          Damage::BondState                 &bond)
  {
    double     lowest = std::numeric_limits<double>::infinity();
    const auto check  = [&](const unsigned int       law,
                           const Damage::Strengths &strengths) {
      bond.axes      = materials.axes[law];
      bond.strengths = strengths;
      lowest         = std::min(lowest, rule.load_factor(bond));
    };
    for (const unsigned int law : states.laws.row(nodes[0]))
      {
        const auto *first  = states.find(nodes[0], law);
        const auto *second = states.find(nodes[1], law);
        if (second == nullptr || !(first->exists || second->exists))
          continue;
        const auto &a = first->exists ? *first : *second;
        const auto &b = second->exists ? *second : *first;
        bond.stress   = 0.5 * (a.stress + b.stress);

        const unsigned int material     = materials.material_of_law[law];
        bool               on_interface = false;
        for (const unsigned int node : nodes)
          for (const unsigned int other : states.laws.row(node))
            {
              std::array<unsigned int, 2> pair = {
                {material, materials.material_of_law[other]}};
              std::sort(pair.begin(), pair.end());
              const auto strengths = table.interfaces.find(pair);
              if (strengths == table.interfaces.end())
                continue;
              on_interface = true;
              check(law, strengths->second);
              check(other, strengths->second);
            }
        if (!on_interface)
          check(law, table.materials[material]);
      }
    return lowest;
  }

#define PERIMORPH_INSTANTIATE(dim)              \
  template double load_factor_by_strength<dim>( \
    const std::array<unsigned int, 2> &,        \
    const ParticleStates &,                     \
    const BodyMaterials<dim> &,                 \
    const StrengthTable &,                      \
    const Damage::BreakingRule &,               \
    Damage::BondState &);

  PERIMORPH_INSTANTIATE(2)
  PERIMORPH_INSTANTIATE(3)
#undef PERIMORPH_INSTANTIATE
} // namespace Perimorph::Coupling
