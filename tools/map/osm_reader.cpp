// OpenStreetMap through libosmium: relations first, then nodes, ways and what they make together.
#include <algorithm>
#include <osmium/area/assembler.hpp>
#include <osmium/area/multipolygon_manager.hpp>
#include <osmium/area/problem_reporter.hpp>
#include <osmium/handler.hpp>
#include <osmium/handler/node_locations_for_ways.hpp>
#include <osmium/index/map/flex_mem.hpp>
#include <osmium/index/map/sparse_mem_array.hpp>
#include <osmium/io/any_input.hpp>
#include <osmium/object_pointer_collection.hpp>
#include <osmium/osm/object_comparisons.hpp>
#include <osmium/visitor.hpp>
#include <set>
#include <unordered_map>
#include <utility>

#include "tools/map/map_readers.hpp"
#include "tools/map/osm_rules.hpp"
#include "tools/map/osm_xml.hpp"
#include "tools/program/exit_status.hpp"
#include "tools/program/progress.hpp"

namespace iog::tools {
namespace {

using Id = osmium::object_id_type;
using osm::Ruling;
using osm::Taking;

std::string name_of(const char* type, Id id) {
  return std::string(type) + ' ' + std::to_string(id);
}

std::string name_of(const osmium::Area& area) {
  return name_of(area.from_way() ? "way" : "relation", area.orig_id());
}

GeoPoint point_of(const osmium::Location& location) {
  return {location.lat_without_check(), location.lon_without_check()};
}

// Which fault kept an object from becoming an area.
class Faults : public osmium::area::ProblemReporter {
 public:
  void report_intersection(Id, osmium::Location, osmium::Location, Id, osmium::Location,
                           osmium::Location, osmium::Location) override {
    set(kCrossesItself);
  }
  void report_ring_not_closed(const osmium::NodeRef&, const osmium::Way*) override {
    set("area whose outline is open");
  }
  void report_invalid_location(Id, Id) override { set("area with a node that is missing"); }

  [[nodiscard]] const char* of(const osmium::Area& area) const {
    const auto found = faults_.find({area.from_way(), area.orig_id()});
    return found != faults_.end() ? found->second : "area without an outline";
  }

 private:
  struct Hash {
    std::size_t operator()(const std::pair<bool, Id>& key) const {
      return std::hash<Id>()(key.second * 2 + (key.first ? 1 : 0));
    }
  };
  void set(const char* fault) {
    faults_[{m_object_type == osmium::item_type::way, m_object_id}] = fault;
  }
  std::unordered_map<std::pair<bool, Id>, const char*, Hash> faults_;
};

// Takes the nodes and ways of a file, and the areas that libosmium makes of them.
class Collector : public osmium::handler::Handler {
 public:
  explicit Collector(GeoMap& out) : map_(out) {}

  void node(const osmium::Node& node) {
    if (has_way_) {
      throw osmium::out_of_order_error("a node after a way", node.id());
    }
    if (node.location().valid()) {
      map_.box.extend(point_of(node.location()));
    }
    look_at(node);
  }

  void way(const osmium::Way& way) {
    has_way_ = true;
    look_at(way);
    if (const Ruling ruling = osm::line_ruling(way.tags()); ruling.taking == Taking::kRoadLine) {
      take_road(way);
    } else if (ruling.taking == Taking::kRefused) {
      map_.census.refuse(ruling.why, name_of("way", way.id()));
    }
    refuse_broken_outline(way);
  }

  void relation(const osmium::Relation& relation) {
    look_at(relation);
    if (is_area(relation.tags()) && relation.tags().has_tag("type", "multipolygon")) {
      waiting_.insert(relation.id());
    }
  }

  void take_area(const osmium::Area& area, const Faults& faults) {
    if (!area.from_way()) {
      waiting_.erase(area.orig_id());
    }
    const Ruling ruling = osm::area_ruling(area.tags());
    if (ruling.taking == Taking::kNothing) {
      return;
    }
    const std::string id = name_of(area);
    if (ruling.taking == Taking::kRefused) {
      map_.census.refuse(ruling.why, id);
      return;
    }
    if (area.num_rings().first == 0) {
      map_.census.refuse(faults.of(area), id);
      return;
    }
    const map::Kind kind =
        ruling.taking == Taking::kRoadArea ? map::Kind::kRoad : map::Kind::kBuilding;
    for (const auto& outer : area.outer_rings()) {
      GeoArea taken{.kind = kind, .rings = {points_of(outer)}, .id = id, .as = census_name(kind)};
      for (const auto& inner : area.inner_rings(outer)) {
        taken.rings.push_back(points_of(inner));
      }
      map_.areas.push_back(std::move(taken));
    }
  }

  // A multipolygon of which the file lacks ways.
  void refuse_incomplete(const osmium::Relation& relation) {
    if (waiting_.erase(relation.id()) > 0) {
      map_.census.refuse("multipolygon of which ways are missing",
                         name_of("relation", relation.id()));
    }
  }

  // What could only be known at the end: where roads meet, and what libosmium gave up in silence.
  void finish() {
    for (const Id id : waiting_) {
      map_.census.refuse("area with a node that is missing", name_of("relation", id));
    }
    for (std::size_t i = 0; i < map_.roads.size(); ++i) {
      map_.roads[i].is_round_at_start = uses_[ends_[i].first] > 1;
      map_.roads[i].is_round_at_end = uses_[ends_[i].second] > 1;
    }
    map_.date_s = date_s_;
  }

 private:
  static bool is_area(const osmium::TagList& tags) {
    const Taking taking = osm::area_ruling(tags).taking;
    return taking == Taking::kBuilding || taking == Taking::kRoadArea;
  }

  static bool has_all_nodes(const osmium::Way& way) {
    return std::ranges::all_of(way.nodes(),
                               [](const osmium::NodeRef& node) { return node.location().valid(); });
  }

  template <typename Nodes>
  static std::vector<GeoPoint> points_of(const Nodes& ring) {
    std::vector<GeoPoint> points;
    for (const osmium::NodeRef& node : ring) {
      points.push_back(point_of(node.location()));
    }
    points.pop_back();  // the first again
    return points;
  }

  void look_at(const osmium::OSMObject& object) {
    if (!object.visible()) {
      throw osmium::out_of_order_error("an object that is deleted", object.id());
    }
    date_s_ = std::max(date_s_, static_cast<std::uint32_t>(object.timestamp()));
  }

  void take_road(const osmium::Way& way) {
    const std::string id = name_of("way", way.id());
    if (way.nodes().size() < 2 || !has_all_nodes(way)) {
      map_.census.refuse(
          has_all_nodes(way) ? "road of fewer than two nodes" : "road with a node that is missing",
          id);
      return;
    }
    const osm::Width width = osm::width_of(way.tags());
    GeoRoad road{.width_m = width.metres, .id = id, .as = width.from, .assumed = width.remark};
    for (const osmium::NodeRef& node : way.nodes()) {
      road.line.push_back(point_of(node.location()));
      ++uses_[node.ref()];
    }
    ends_.emplace_back(way.nodes().front().ref(), way.nodes().back().ref());
    map_.roads.push_back(std::move(road));
  }

  // libosmium does not even try to make an area of these.
  void refuse_broken_outline(const osmium::Way& way) {
    const auto& nodes = way.nodes();
    if (!is_area(way.tags()) || way.tags().has_tag("area", "no")) {
      return;
    }
    const std::string id = name_of("way", way.id());
    if (nodes.empty() || !has_all_nodes(way)) {
      map_.census.refuse("area with a node that is missing", id);
    } else if (nodes.front().location() != nodes.back().location()) {
      map_.census.refuse("area whose outline is open", id);
    } else if (nodes.size() < 4) {
      map_.census.refuse("area of fewer than three nodes", id);
    }
  }

  GeoMap& map_;
  bool has_way_ = false;
  std::uint32_t date_s_ = 0;
  std::set<Id> waiting_;                        // multipolygons that nothing was said of yet
  std::unordered_map<Id, std::uint32_t> uses_;  // of a node by roads
  std::vector<std::pair<Id, Id>> ends_;         // of each road
};

osmium::TagsFilter areas_of_interest() {
  osmium::TagsFilter filter{false};
  for (const char* const key : {"building", "building:part", "area:highway"}) {
    filter.add_rule(true, osmium::TagMatcher{key});
  }
  filter.add_rule(true, osmium::TagMatcher{"area", "yes"});
  return filter;
}

std::optional<GeoExtent> bounds_of(const osmium::io::Header& header) {
  GeoExtent bounds;
  for (const osmium::Box& box : header.boxes()) {
    if (box.valid()) {
      bounds.extend(point_of(box.bottom_left()));
      bounds.extend(point_of(box.top_right()));
    }
  }
  return bounds.is_empty() ? std::nullopt : std::optional(bounds);
}

// Beside other handlers: shows how much of the file has been read.
class Watched : public osmium::handler::Handler {
 public:
  Watched(const std::string& what, const osmium::io::Reader& reader)
      : reader_(&reader), progress_(what) {}

  void osm_object(const osmium::OSMObject& /*object*/) {
    constexpr std::uint64_t kSeldom = 1024;
    if (++objects_ % kSeldom == 0) {
      progress_.show(objects_, static_cast<double>(reader_->offset()) /
                                   static_cast<double>(reader_->file_size()));
    }
  }

 private:
  const osmium::io::Reader* reader_;
  Progress progress_;
  std::uint64_t objects_ = 0;
};

// A file whose objects are in the usual order: by type, then by number.
class OrderedFile {
 public:
  explicit OrderedFile(const osmium::io::File& file) : file_(file) {}

  template <typename Areas>
  void read_relations(Areas& areas) {
    osmium::io::Reader reader(file_, osmium::osm_entity_bits::relation);
    Watched watched("relations", reader);
    osmium::apply(reader, areas, watched);
    reader.close();
    areas.prepare_for_lookup();
  }
  template <typename... Handlers>
  std::optional<GeoExtent> read(Handlers&&... handlers) {
    osmium::io::Reader reader(file_);
    const auto bounds = bounds_of(reader.header());
    Watched watched("objects", reader);
    osmium::apply(reader, handlers..., watched);
    reader.close();
    return bounds;
  }

 private:
  const osmium::io::File& file_;
};

osm::Objects all_of(const osmium::io::File& file) {
  osmium::io::Reader reader(file);
  osm::Objects all{.bounds = bounds_of(reader.header())};
  while (const osmium::memory::Buffer part = reader.read()) {
    all.objects.add_buffer(part);
    all.objects.commit();
  }
  reader.close();
  return all;
}

// Any file, put in order in memory; of several versions of an object the last, if that is not its
// deletion.
class SortedFile {
 public:
  explicit SortedFile(osm::Objects&& all) : all_(std::move(all)) {
    osmium::ObjectPointerCollection versions;
    osmium::apply(all_.objects, versions);
    versions.sort(osmium::object_order_type_id_reverse_version());
    versions.unique(osmium::object_equal_type_id());
    for (osmium::OSMObject& object : versions) {
      if (object.visible()) {
        objects_.osm_object(object);
      }
    }
  }

  template <typename Areas>
  void read_relations(Areas& areas) {
    osmium::apply(objects_.begin(), objects_.end(), areas);
    areas.prepare_for_lookup();
  }
  template <typename... Handlers>
  std::optional<GeoExtent> read(Handlers&&... handlers) {
    osmium::apply(objects_.begin(), objects_.end(), handlers...);
    return all_.bounds;
  }

 private:
  osm::Objects all_;
  osmium::ObjectPointerCollection objects_;
};

template <typename File>
void read(File&& file, GeoMap& map) {
  Faults faults;
  osmium::area::Assembler::config_type config;
  config.problem_reporter = &faults;
  osmium::area::MultipolygonManager<osmium::area::Assembler> areas(config, areas_of_interest());
  file.read_relations(areas);

  using Positive = osmium::index::map::FlexMem<osmium::unsigned_object_id_type, osmium::Location>;
  using Negative =
      osmium::index::map::SparseMemArray<osmium::unsigned_object_id_type, osmium::Location>;
  Positive positive;
  Negative negative;
  osmium::handler::NodeLocationsForWays<Positive, Negative> locations(positive, negative);
  locations.ignore_errors();
  Collector collector(map);
  const auto take_areas = [&](const osmium::memory::Buffer& buffer) {
    for (const auto& area : buffer.select<osmium::Area>()) {
      collector.take_area(area, faults);
    }
  };
  map.bounds =
      file.read(locations, collector,
                areas.handler([&](osmium::memory::Buffer&& buffer) { take_areas(buffer); }));
  take_areas(areas.read());
  areas.for_each_incomplete_relation([&](const osmium::relations::RelationHandle& handle) {
    collector.refuse_incomplete(*handle);
  });
  collector.finish();
}

GeoMap empty_map() {
  return {.source = map::Source::kOpenStreetMap,
          .attribution = "\u00A9 OpenStreetMap contributors, ODbL 1.0"};
}

}  // namespace

GeoMap read_osm(const std::string& path, const std::string& formats) {
  try {
    const osmium::io::File file(path);
    GeoMap map = empty_map();
    if (file.format() == osmium::io::file_format::xml) {
      read(SortedFile(osm::read_xml(file)), map);
      return map;
    }
    try {
      read(OrderedFile(file), map);
    } catch (const osmium::out_of_order_error&) {
      map = empty_map();
      read(SortedFile(all_of(file)), map);
    }
    return map;
  } catch (const std::exception& error) {
    const std::string why = error.what();
    throw UsageError(path + (why.starts_with("Could not detect file format")
                                 ? ": use " + formats
                                 : ": not readable as OpenStreetMap data: " + why));
  }
}

}  // namespace iog::tools
