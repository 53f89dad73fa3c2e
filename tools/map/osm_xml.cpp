#include "tools/map/osm_xml.hpp"

#include <algorithm>
#include <cstring>
#include <exception>
#include <expat.h>
#include <memory>
#include <osmium/builder/attr.hpp>
#include <osmium/io/any_compression.hpp>
#include <osmium/io/detail/read_write.hpp>
#include <stdexcept>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

#include "tools/program/progress.hpp"

namespace iog::tools::osm {
namespace {

using Id = osmium::object_id_type;

// The attributes of an element, as expat has them: names and values in turn, a null behind them.
class Attributes {
 public:
  explicit Attributes(const char** all) : all_(all) {}

  [[nodiscard]] const char* of(const char* name) const {
    for (const char* const* at = all_; *at != nullptr; at += 2) {
      if (std::strcmp(*at, name) == 0) {
        return at[1];
      }
    }
    return nullptr;
  }
  [[nodiscard]] bool is(const char* name, std::string_view value) const {
    const char* const found = of(name);
    return found != nullptr && found == value;
  }
  [[nodiscard]] Id id(const char* name) const {
    const char* const found = of(name);
    return found == nullptr ? 0 : osmium::string_to_object_id(found);
  }
  [[nodiscard]] osmium::Location place(const char* latitude = "lat",
                                       const char* longitude = "lon") const {
    osmium::Location place;
    if (of(latitude) != nullptr && of(longitude) != nullptr) {
      place.set_lat(of(latitude));
      place.set_lon(of(longitude));
    }
    return place;
  }

 private:
  const char** all_;
};

// An object until its element ends.
struct Object {
  Id id = 0;
  osmium::object_version_type version = 1;  // more than of a way that is only a member
  bool is_deleted = false;
  osmium::Timestamp time{};
  osmium::Location place{};
  std::vector<osmium::NodeRef> nodes{};
  std::vector<osmium::builder::attr::member_type_string> members{};
  std::vector<std::pair<std::string, std::string>> tags{};
};

class Reader {
 public:
  explicit Reader(Objects& out) : out_(out) {}

  void begin(std::string_view element, const Attributes& attributes) {
    const std::string_view parent = path_.empty() ? std::string_view() : path_.back();
    const bool is_object = element == "node" || element == "way" || element == "relation";
    if (path_.empty()) {
      demand_osm(element, attributes);
    } else if (is_object) {
      demand_known(element, parent);
      begin_object(attributes, parent == "delete");
    } else if (element == "bounds" && parent == "osm") {
      take_bounds(attributes);
    } else if (element == "nd" && parent == "way") {
      object_.nodes.push_back(node_of(attributes));
    } else if (element == "nd" && parent == "member") {
      member_nodes_.push_back(node_of(attributes));
    } else if (element == "member" && parent == "relation") {
      take_member(attributes);
    } else if (element == "tag" && attributes.of("k") != nullptr && attributes.of("v") != nullptr) {
      object_.tags.emplace_back(attributes.of("k"), attributes.of("v"));
    }
    path_.emplace_back(element);
  }

  void text(std::string_view text) {
    if (!path_.empty() && path_.back() == "remark") {
      remark_ += text;
    }
  }

  void end() {
    const std::string element = std::move(path_.back());
    path_.pop_back();
    if (element == "node") {
      add_node(object_);
    } else if (element == "way") {
      add_way(object_);
    } else if (element == "relation") {
      add_relation();
    } else if (element == "member") {
      end_member();
    } else if (element == "remark") {
      throw std::runtime_error("its server has not sent all of it: " + remark_);
    }
  }

 private:
  // Nodes made of coordinates have ids from here on; OpenStreetMap's are far below.
  static constexpr Id kFirstPlace = Id{1} << 46;

  static void demand_osm(std::string_view element, const Attributes& attributes) {
    if (element != "osm" && element != "osmChange") {
      throw std::runtime_error("it begins with <" + std::string(element) + ">, not with <osm>");
    }
    if (!attributes.is("version", "0.6")) {
      throw std::runtime_error("it is not of version 0.6");
    }
  }
  static void demand_known(std::string_view element, std::string_view parent) {
    for (const char* const known : {"osm", "osmChange", "create", "modify", "delete"}) {
      if (parent == known) {
        return;
      }
    }
    throw std::runtime_error("it has a " + std::string(element) + " within <" +
                             std::string(parent) + ">");
  }

  void begin_object(const Attributes& attributes, bool is_deleted) {
    object_ = {.id = attributes.id("id"), .place = attributes.place()};
    object_.is_deleted =
        is_deleted || attributes.is("action", "delete") || attributes.is("visible", "false");
    if (const char* const version = attributes.of("version")) {
      object_.version = std::max(object_.version, osmium::string_to_object_version(version));
    }
    if (const char* const time = attributes.of("timestamp")) {
      object_.time = osmium::Timestamp(time);
    }
  }

  void take_bounds(const Attributes& attributes) {
    const osmium::Location low = attributes.place("minlat", "minlon");
    const osmium::Location high = attributes.place("maxlat", "maxlon");
    if (low.valid() && high.valid()) {
      GeoExtent bounds = out_.bounds.value_or(GeoExtent());
      bounds.extend({low.lat(), low.lon()});
      bounds.extend({high.lat(), high.lon()});
      out_.bounds = bounds;
    }
  }

  // A place that stands beside the reference, or instead of it, becomes a node.
  osmium::NodeRef node_of(const Attributes& attributes) {
    const osmium::Location place = attributes.place();
    Id id = attributes.id("ref");
    if (place.valid()) {
      const auto key = static_cast<std::uint64_t>(static_cast<std::uint32_t>(place.x())) << 32U |
                       static_cast<std::uint32_t>(place.y());
      if (id == 0) {
        id = places_.try_emplace(key, kFirstPlace + static_cast<Id>(places_.size())).first->second;
      }
      if (placed_.insert(id).second) {
        add_node({.id = id, .version = 0, .place = place});
      }
    }
    return {id, place};
  }

  void take_member(const Attributes& attributes) {
    const char* const type = attributes.of("type");
    const char* const role = attributes.of("role");
    object_.members.emplace_back(osmium::char_to_item_type(type == nullptr ? 'x' : *type),
                                 attributes.id("ref"), role == nullptr ? "" : role);
    if (object_.members.back().type() == osmium::item_type::undefined) {
      throw std::runtime_error("it has a member of no type");
    }
  }
  // A way that is given by its places alone: it has no tags, and gives way to one of the file.
  void end_member() {
    if (!member_nodes_.empty()) {
      add_way({.id = object_.members.back().ref(), .version = 0, .nodes = member_nodes_});
    }
    member_nodes_.clear();
  }

  void add_node(const Object& node) {
    using namespace osmium::builder::attr;
    osmium::builder::add_node(out_.objects, _id(node.id), _version(node.version),
                              _deleted(node.is_deleted), _timestamp(node.time),
                              _location(node.place), _tags(node.tags));
  }
  void add_way(const Object& way) {
    using namespace osmium::builder::attr;
    osmium::builder::add_way(out_.objects, _id(way.id), _version(way.version),
                             _deleted(way.is_deleted), _timestamp(way.time), _nodes(way.nodes),
                             _tags(way.tags));
  }
  void add_relation() {
    using namespace osmium::builder::attr;
    osmium::builder::add_relation(out_.objects, _id(object_.id), _version(object_.version),
                                  _deleted(object_.is_deleted), _timestamp(object_.time),
                                  _members(object_.members), _tags(object_.tags));
  }

  Objects& out_;
  std::vector<std::string> path_;  // the elements that are open
  Object object_;
  std::vector<osmium::NodeRef> member_nodes_;
  std::string remark_;
  std::unordered_map<std::uint64_t, Id> places_;
  std::unordered_set<Id> placed_;
};

// Expat, which must not see an exception.
class Parser {
 public:
  explicit Parser(Objects& out) : reader_(out) {
    XML_SetUserData(expat_.get(), this);
    XML_SetElementHandler(expat_.get(), begin, end);
    XML_SetCharacterDataHandler(expat_.get(), text);
    XML_SetEntityDeclHandler(expat_.get(), refuse_entity);
  }

  void take(const std::string& part, bool is_last) {
    const int length = static_cast<int>(part.size());
    if (XML_Parse(expat_.get(), part.data(), length, is_last ? 1 : 0) != XML_STATUS_ERROR) {
      return;
    }
    if (failure_) {
      std::rethrow_exception(failure_);
    }
    throw std::runtime_error("line " + std::to_string(XML_GetCurrentLineNumber(expat_.get())) +
                             ": " + XML_ErrorString(XML_GetErrorCode(expat_.get())));
  }

 private:
  template <typename Do>
  static void guarded(void* self, Do what) {
    auto& parser = *static_cast<Parser*>(self);
    if (parser.failure_) {
      return;
    }
    try {
      what(parser.reader_);
    } catch (const std::exception& error) {
      parser.failure_ = std::make_exception_ptr(std::runtime_error(
          "line " + std::to_string(XML_GetCurrentLineNumber(parser.expat_.get())) + ": " +
          error.what()));
      XML_StopParser(parser.expat_.get(), XML_FALSE);
    }
  }
  static void begin(void* self, const char* element, const char** attributes) {
    guarded(self, [&](Reader& reader) { reader.begin(element, Attributes(attributes)); });
  }
  static void end(void* self, const char* /*element*/) {
    guarded(self, [](Reader& reader) { reader.end(); });
  }
  static void text(void* self, const char* text, int length) {
    guarded(self, [&](Reader& reader) {
      reader.text(std::string_view(text, static_cast<std::size_t>(length)));
    });
  }
  // They can make a file endless.
  static void refuse_entity(void* self, const char* /*name*/, int /*is_parameter*/,
                            const char* /*value*/, int /*length*/, const char* /*base*/,
                            const char* /*system*/, const char* /*id*/, const char* /*notation*/) {
    guarded(self, [](Reader&) { throw std::runtime_error("it declares entities"); });
  }

  struct Closer {
    void operator()(XML_Parser expat) const { XML_ParserFree(expat); }
  };
  std::unique_ptr<std::remove_pointer_t<XML_Parser>, Closer> expat_{XML_ParserCreate(nullptr)};
  Reader reader_;
  std::exception_ptr failure_;
};

}  // namespace

Objects read_xml(const osmium::io::File& file) {
  const int descriptor = osmium::io::detail::open_for_reading(file.filename());
  const double bytes = static_cast<double>(osmium::file_size(descriptor));
  const auto unpacked = osmium::io::CompressionFactory::instance().create_decompressor(
      file.compression(), descriptor);
  std::atomic<std::size_t> offset = 0;
  unpacked->set_offset_ptr(&offset);
  Objects read;
  Parser parser(read);
  Progress progress("bytes");
  for (std::string part = unpacked->read(); !part.empty(); part = unpacked->read()) {
    parser.take(part, false);
    progress.show(offset, static_cast<double>(offset) / bytes);
  }
  parser.take({}, true);
  unpacked->close();
  return read;
}

}  // namespace iog::tools::osm
