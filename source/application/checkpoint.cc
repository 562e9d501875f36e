#include <perimorph/application/checkpoint.h>
#include <perimorph/base/exceptions.h>
#include <perimorph/base/name_help.h>
#include <perimorph/parameters/reader.h>

#include <zlib.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>
#include <set>

namespace Perimorph::Application
{
  namespace
  {
    /// Entries that a resumed run may have otherwise.
    const std::set<std::string> free_entries = {"Output folder",
                                                "Output / checkpoint"};

    std::optional<double>
    as_number(const std::string &text)
    {
      double     value;
      const auto end  = text.data() + text.size();
      const auto read = std::from_chars(text.data(), end, value);
      if (read.ec != std::errc() || read.ptr != end)
        return std::nullopt;
      return value;
    }

    bool
    same_value(const std::string &a, const std::string &b)
    {
      const auto number = as_number(a);
      return a == b || (number && number == as_number(b));
    }

    std::string
    quoted(const std::string &value)
    {
      return value.empty() ? "nothing" : "'" + value + "'";
    }

    template <typename T>
    void
    add_to_sum(const std::vector<T> &values, unsigned long &sum)
    {
      sum = crc32_z(sum,
                    reinterpret_cast<const unsigned char *>(values.data()),
                    sizeof(T) * values.size());
    }

    /// The way back from DistributedMesh::node_of_file_point().
    template <int dim>
    std::vector<unsigned int>
    file_point_of_node(const Mesh::DistributedMesh<dim> &mesh)
    {
      const auto               &node_of_point = mesh.node_of_file_point();
      std::vector<unsigned int> point_of_node(node_of_point.size());
      for (unsigned int point = 0; point < node_of_point.size(); ++point)
        point_of_node[node_of_point[point]] = point;
      return point_of_node;
    }

    /// CRC-32 of the mesh in the numbering of its file.
    template <int dim>
    unsigned long
    mesh_sum(const Mesh::DistributedMesh<dim> &mesh)
    {
      const auto         &nodal         = mesh.nodal();
      const auto          point_of_node = file_point_of_node(mesh);
      std::vector<double> places;
      for (const unsigned int node : mesh.node_of_file_point())
        for (int d = 0; d < dim; ++d)
          places.push_back(nodal.nodes[node][d]);
      std::vector<unsigned int> cells;
      for (const auto &cell : nodal.cells)
        for (const unsigned int node : cell)
          cells.push_back(point_of_node[node]);
      // The order of faces follows the numbering of the run: sort them.
      std::vector<std::array<unsigned int, (1u << (dim - 1)) + 1>> faces;
      for (const auto &face : nodal.boundary_faces)
        {
          faces.emplace_back();
          auto &numbers = faces.back();
          std::transform(
            face.nodes.begin(),
            face.nodes.end(),
            numbers.begin(),
            [&](const unsigned int n) { return point_of_node[n]; });
          std::sort(numbers.begin(), numbers.end() - 1);
          numbers.back() = face.boundary;
        }
      std::sort(faces.begin(), faces.end());
      unsigned long sum = 0;
      add_to_sum(places, sum);
      add_to_sum(cells, sum);
      add_to_sum(nodal.cell_material, sum);
      add_to_sum(faces, sum);
      return sum;
    }

    template <int dim>
    std::vector<std::string>
    group_names(const Mesh::DistributedMesh<dim> &mesh)
    {
      auto names = mesh.boundary_names();
      for (const auto &name : mesh.volume_names())
        names.push_back(name);
      return names;
    }
  } // namespace

  std::string
  checkpoint_file(const std::string &folder)
  {
    return folder + "/checkpoint";
  }

  void
  store_parameters(const dealii::ParameterHandler &prm,
                   Output::Checkpoint             &checkpoint)
  {
    auto &names  = checkpoint.words["parameters"];
    auto &values = checkpoint.words["values of parameters"];
    names.clear();
    values.clear();
    for (const auto &entry : Parameters::list_entries(prm))
      {
        names.push_back(entry.path());
        values.push_back(entry.value);
      }
    checkpoint.words["version"] = {PERIMORPH_VERSION};
  }

  void
  compare_parameters(const dealii::ParameterHandler &prm,
                     const Output::Checkpoint       &checkpoint,
                     const std::string              &file,
                     Base::InputErrorCollector      &errors)
  {
    const auto  entries = Parameters::list_entries(prm);
    const auto &version = checkpoint.words.at("version").at(0);
    const auto &names   = checkpoint.words.at("parameters");
    const auto &values  = checkpoint.words.at("values of parameters");
    bool        same    = names.size() == entries.size();
    for (unsigned int k = 0; same && k < entries.size(); ++k)
      same = names[k] == entries[k].path();
    if (!same || version != PERIMORPH_VERSION)
      {
        errors.add(
          Base::InputMessage{"checkpoint '" + file + "'",
                             "the file of Perimorph " + version +
                               (same ? "" : " with other entries"),
                             "one of this Perimorph " PERIMORPH_VERSION,
                             ""});
        return;
      }
    for (unsigned int k = 0; k < entries.size(); ++k)
      if (free_entries.count(names[k]) == 0 &&
          !same_value(entries[k].value, values[k]))
        errors.add_parameter(names[k],
                             quoted(entries[k].value),
                             quoted(values[k]) +
                               ", as in the run of the checkpoint '" + file +
                               "'");
  }

  template <int dim>
  void
  store_mesh(const Mesh::DistributedMesh<dim> &mesh,
             Output::Checkpoint               &checkpoint)
  {
    checkpoint.numbers["nodes of mesh"] = mesh.nodal().n_nodes();
    checkpoint.numbers["cells of mesh"] = mesh.nodal().n_cells();
    checkpoint.numbers["sum of mesh"]   = mesh_sum(mesh);
    checkpoint.words["groups of mesh"]  = group_names(mesh);
  }

  template <int dim>
  void
  compare_mesh(const Mesh::DistributedMesh<dim> &mesh,
               const std::string                &mesh_file,
               const Output::Checkpoint         &checkpoint,
               const std::string                &file)
  {
    Output::Checkpoint here;
    store_mesh(mesh, here);
    const auto size = [](const Output::Checkpoint &of) {
      const auto number = [&](const std::string &name) {
        return std::to_string(
          static_cast<unsigned long>(of.numbers.at(name + " of mesh")));
      };
      return number("nodes") + " nodes and " + number("cells") + " cells";
    };
    const auto groups = [](const Output::Checkpoint &of) {
      return "the groups " + Base::join_names(of.words.at("groups of mesh"));
    };
    std::string found, allowed;
    if (size(here) != size(checkpoint))
      {
        found   = size(here);
        allowed = size(checkpoint);
      }
    else if (groups(here) != groups(checkpoint))
      {
        found   = groups(here);
        allowed = groups(checkpoint);
      }
    else if (here.numbers.at("sum of mesh") !=
             checkpoint.numbers.at("sum of mesh"))
      {
        found   = "nodes at other places, other cells or other groups";
        allowed = "the same mesh";
      }
    if (!found.empty())
      throw Base::InputError(Base::InputMessage{
        "mesh '" + mesh_file + "'",
        found,
        allowed + ", as in the run of the checkpoint '" + file + "'",
        ""});
  }

  template <int dim>
  std::vector<double>
  in_file_order(const Mesh::DistributedMesh<dim>          &mesh,
                const std::vector<dealii::Tensor<1, dim>> &values)
  {
    std::vector<double> numbers;
    numbers.reserve(dim * values.size());
    for (const unsigned int node : mesh.node_of_file_point())
      for (int d = 0; d < dim; ++d)
        numbers.push_back(values[node][d]);
    return numbers;
  }

  template <int dim>
  std::vector<double>
  in_file_order(const Mesh::DistributedMesh<dim> &mesh,
                const std::vector<double>        &values)
  {
    std::vector<double> numbers;
    numbers.reserve(values.size());
    for (const unsigned int node : mesh.node_of_file_point())
      numbers.push_back(values[node]);
    return numbers;
  }

  template <int dim>
  std::vector<dealii::Tensor<1, dim>>
  vectors_from_file_order(const Mesh::DistributedMesh<dim> &mesh,
                          const std::vector<double>        &numbers)
  {
    std::vector<dealii::Tensor<1, dim>> values(numbers.size() / dim);
    for (std::size_t point = 0; point < values.size(); ++point)
      for (int d = 0; d < dim; ++d)
        values[mesh.node_of_file_point()[point]][d] = numbers[dim * point + d];
    return values;
  }

  template <int dim>
  std::vector<double>
  from_file_order(const Mesh::DistributedMesh<dim> &mesh,
                  const std::vector<double>        &numbers)
  {
    std::vector<double> values(numbers.size());
    for (std::size_t point = 0; point < values.size(); ++point)
      values[mesh.node_of_file_point()[point]] = numbers[point];
    return values;
  }

  template <int dim>
  void
  store_points(const std::vector<dealii::Point<dim>> &points,
               std::vector<double>                   &numbers)
  {
    numbers.clear();
    for (const auto &point : points)
      for (int d = 0; d < dim; ++d)
        numbers.push_back(point[d]);
  }

  template <int dim>
  std::vector<dealii::Point<dim>>
  stored_points(const std::vector<double> &numbers)
  {
    std::vector<dealii::Point<dim>> points(numbers.size() / dim);
    for (std::size_t k = 0; k < points.size(); ++k)
      for (int d = 0; d < dim; ++d)
        points[k][d] = numbers[dim * k + d];
    return points;
  }

  template <int dim>
  void
  store_advances(const Bonds::CrackSet<dim> &cracks,
                 Output::Checkpoint         &checkpoint)
  {
    std::vector<dealii::Point<dim>> corners;
    auto &advances = checkpoint.arrays["numbers of advances"];
    auto &numbers  = checkpoint.arrays["cracks of advances"];
    for (auto *array : {&advances, &numbers})
      array->clear();
    for (const auto &facet : cracks.facets())
      if (facet.step > 0)
        {
          corners.insert(corners.end(),
                         facet.corners.begin(),
                         facet.corners.end());
          advances.push_back(facet.step);
          numbers.push_back(facet.crack);
        }
    store_points(corners, checkpoint.arrays["corners of advances"]);
  }

  template <int dim>
  std::vector<Bonds::CrackFacet<dim>>
  stored_advances(const Output::Checkpoint &checkpoint)
  {
    const auto corners =
      stored_points<dim>(checkpoint.arrays.at("corners of advances"));
    const auto &advances = checkpoint.arrays.at("numbers of advances");
    const auto &numbers  = checkpoint.arrays.at("cracks of advances");
    std::vector<Bonds::CrackFacet<dim>> facets(advances.size());
    for (std::size_t k = 0; k < facets.size(); ++k)
      {
        for (int c = 0; c < dim; ++c)
          facets[k].corners[c] = corners[dim * k + c];
        facets[k].step  = static_cast<unsigned int>(advances[k]);
        facets[k].crack = static_cast<unsigned int>(numbers[k]);
      }
    return facets;
  }

  template <int dim>
  void
  store_broken_bonds(const Mesh::DistributedMesh<dim> &mesh,
                     const Bonds::BrokenBonds         &broken,
                     Output::Checkpoint               &checkpoint)
  {
    const auto point_of_node = file_point_of_node(mesh);
    auto      &numbers       = checkpoint.arrays["broken bonds"];
    numbers.clear();
    for (const auto &bond : broken.list())
      {
        for (const unsigned int node : bond.nodes)
          numbers.push_back(point_of_node[node]);
        numbers.push_back(bond.event);
        numbers.push_back(bond.teeth);
      }
    checkpoint.numbers["teeth of bonds"] = broken.n_teeth();
  }

  template <int dim>
  Bonds::BrokenBonds
  stored_broken_bonds(const Mesh::DistributedMesh<dim> &mesh,
                      const Output::Checkpoint         &checkpoint)
  {
    const auto        &node_of_point = mesh.node_of_file_point();
    const auto        &numbers       = checkpoint.arrays.at("broken bonds");
    Bonds::BrokenBonds broken(
      static_cast<unsigned int>(checkpoint.numbers.at("teeth of bonds")));
    for (std::size_t k = 0; k + 3 < numbers.size(); k += 4)
      for (unsigned int tooth = 0; tooth < numbers[k + 3]; ++tooth)
        broken.add(node_of_point[static_cast<unsigned int>(numbers[k])],
                   node_of_point[static_cast<unsigned int>(numbers[k + 1])],
                   static_cast<unsigned int>(numbers[k + 2]));
    return broken;
  }

#define PERIMORPH_INSTANTIATE(dim)                                              \
  template void                store_mesh(const Mesh::DistributedMesh<dim> &,   \
                                          Output::Checkpoint &);                \
  template void                compare_mesh(const Mesh::DistributedMesh<dim> &, \
                                            const std::string &,                \
                                            const Output::Checkpoint &,         \
                                            const std::string &);               \
  template std::vector<double> in_file_order(                                   \
    const Mesh::DistributedMesh<dim> &,                                         \
    const std::vector<dealii::Tensor<1, dim>> &);                               \
  template std::vector<double> in_file_order(                                   \
    const Mesh::DistributedMesh<dim> &,                                         \
    const std::vector<double> &);                                               \
  template std::vector<dealii::Tensor<1, dim>> vectors_from_file_order(         \
    const Mesh::DistributedMesh<dim> &,                                         \
    const std::vector<double> &);                                               \
  template std::vector<double> from_file_order(                                 \
    const Mesh::DistributedMesh<dim> &,                                         \
    const std::vector<double> &);                                               \
  template void store_advances(const Bonds::CrackSet<dim> &,                    \
                               Output::Checkpoint &);                           \
  template std::vector<Bonds::CrackFacet<dim>> stored_advances(                 \
    const Output::Checkpoint &);                                                \
  template void store_points(const std::vector<dealii::Point<dim>> &,           \
                             std::vector<double> &);                            \
  template std::vector<dealii::Point<dim>> stored_points<dim>(                  \
    const std::vector<double> &);                                               \
  template void store_broken_bonds(const Mesh::DistributedMesh<dim> &,          \
                                   const Bonds::BrokenBonds &,                  \
                                   Output::Checkpoint &);                       \
  template Bonds::BrokenBonds stored_broken_bonds(                              \
    const Mesh::DistributedMesh<dim> &,                                         \
    const Output::Checkpoint &);

  PERIMORPH_INSTANTIATE(2)
  PERIMORPH_INSTANTIATE(3)
#undef PERIMORPH_INSTANTIATE
} // namespace Perimorph::Application
