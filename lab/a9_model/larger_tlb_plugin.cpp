// A plugin of QEMU that makes counting faster and changes nothing (larger_tlb.hpp):
//
//   -plugin liblarger_tlb.so
#include "larger_tlb.hpp"

int qemu_plugin_version = 1;

int qemu_plugin_install(qemu_plugin_id_t id, const qemu_info_t* /*info*/, int /*argc*/,
                        char** /*argv*/) {
  qemu_plugin_register_vcpu_tb_trans_cb(id, [](qemu_plugin_id_t /*id*/, qemu_plugin_tb* block) {
    iog::a9_model::watch_supervisor_calls(block);
  });
  return 0;
}
