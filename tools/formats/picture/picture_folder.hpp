// A folder of pictures and ROS maps of one run. Older files of iog are removed; files of others are
// not touched.
#pragma once

#include <string>

namespace iog::tools {

class PictureFolder {
 public:
  // Makes the folder. with_maps: numbered maps, too. UsageError if a file that clear() removes or a
  // run replaces is not iog's.
  PictureFolder(std::string path, bool with_maps);

  [[nodiscard]] const std::string& path() const { return path_; }

  // Removes the numbered files of an earlier run. UsageError as above.
  void clear() const;

 private:
  std::string path_;
  bool with_maps_;
};

}  // namespace iog::tools
