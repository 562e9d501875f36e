#include <perimorph/parameters/lists.h>
#include <perimorph/parameters/polylines.h>
#include <perimorph/parameters/text_tools.h>

#include <deal.II/base/tensor.h>

#include <regex>
#include <set>

namespace Perimorph::Parameters
{
  namespace
  {
    using Vector = dealii::Tensor<1, 3>;

    Vector
    vector_between(const std::vector<double> &a, const std::vector<double> &b)
    {
      Vector v;
      for (unsigned int d = 0; d < a.size(); ++d)
        v[d] = b[d] - a[d];
      return v;
    }

    /// What is wrong with the points; empty if nothing is.
    std::string
    degeneracy(const std::vector<std::vector<double>> &points)
    {
      const bool polygon = !points.empty() && points[0].size() == 3;
      const auto n       = points.size();
      const auto next    = [n](const std::size_t k) { return (k + 1) % n; };
      double     size    = 0.;
      Vector     area;
      const auto n_pieces = polygon ? n : n - 1;
      for (std::size_t k = 0; k < n_pieces; ++k)
        {
          const auto piece = vector_between(points[k], points[next(k)]);
          if (piece.norm() == 0.)
            return "points that differ from the one before";
          size = std::max(size, piece.norm());
          area +=
            0.5 * cross_product_3d(vector_between(points[0], points[k]),
                                   vector_between(points[0], points[next(k)]));
        }
      if (!polygon)
        return "";
      if (!(area.norm() > 1e-12 * size * size))
        return "corners that do not lie in one line";
      const Vector normal = area / area.norm();
      for (std::size_t k = 0; k < n; ++k)
        {
          const auto to = vector_between(points[k], points[next(k)]);
          const auto on =
            vector_between(points[next(k)], points[next(next(k))]);
          if (std::abs(vector_between(points[0], points[k]) * normal) >
              1e-6 * size)
            return "corners in one plane";
          if (cross_product_3d(to, on) * normal < -1e-12 * size * size)
            return "a convex polygon, corners in order";
        }
      return "";
    }
  } // namespace

  std::vector<Polyline>
  parse_polylines(const std::string         &path,
                  const std::string         &text,
                  const unsigned int         dim,
                  Base::InputErrorCollector &errors)
  {
    const std::string form =
      "NAME: " + point_form(dim) + " to " + point_form(dim) +
      (dim == 3 ? " to ... (a flat polygon)" : " to ...") +
      ", or NAME: group NAME";
    std::vector<Polyline> list;
    std::set<std::string> names;
    for (const std::string &entry : split_top_level(text, ';'))
      {
        if (entry.empty())
          continue;
        const auto colon = entry.find(':');
        Polyline   line;
        line.name = trim(entry.substr(0, colon));
        if (colon == std::string::npos || !is_identifier(line.name))
          {
            errors.add_parameter(path,
                                 "'" + entry + "' without a name",
                                 form,
                                 "Entries are separated by ';'");
            continue;
          }
        if (!names.insert(line.name).second)
          {
            errors.add_parameter(path,
                                 "'" + line.name + "' twice",
                                 "each name once");
            continue;
          }
        static const std::regex to("\\s+to\\s+");
        const std::string       rest = trim(entry.substr(colon + 1));
        std::smatch             match;
        static const std::regex group("group\\s+(\\S.*)");
        if (std::regex_match(rest, match, group))
          {
            line.group = match[1];
            list.push_back(line);
            continue;
          }
        const std::sregex_token_iterator end;
        bool                             good = true;
        for (std::sregex_token_iterator part(rest.begin(), rest.end(), to, -1);
             part != end;
             ++part)
          {
            line.points.push_back(
              parse_point(path, entry, trim(part->str()), dim, errors));
            good = good && !line.points.back().empty();
          }
        if (!good)
          continue;
        const unsigned int least = dim;
        if (line.points.size() < least)
          {
            errors.add_parameter(path,
                                 "'" + entry + "' with " +
                                   count_of(line.points.size(), "point"),
                                 "at least " + count_of(least, "point"),
                                 form);
            continue;
          }
        const std::string wrong = degeneracy(line.points);
        if (!wrong.empty())
          errors.add_parameter(path, "'" + entry + "'", wrong);
        else
          list.push_back(line);
      }
    return list;
  }
} // namespace Perimorph::Parameters
