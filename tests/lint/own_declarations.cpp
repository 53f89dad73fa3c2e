// A plugin for clang-tidy that keeps its checks out of the headers of the system.
//
// clang-tidy 14 shows each of its checks every node of a translation unit, drops what they say
// about system headers, and so spends three quarters of its time on GoogleTest, CLI11 and the
// standard library. This plugin runs before clang-tidy's own consumer and narrows what is traversed
// to the declarations of our files. What those files refer to stays as visible as before, and the
// path-sensitive analyzer, which starts from functions and not from this traversal, sees no
// difference. clangd narrows its traversal in the same way.

#include <clang/AST/ASTConsumer.h>
#include <clang/AST/ASTContext.h>
#include <clang/Basic/SourceManager.h>
#include <clang/Frontend/FrontendPluginRegistry.h>
#include <memory>
#include <string>
#include <vector>

namespace {

class OwnDeclarations : public clang::ASTConsumer {
 public:
  void HandleTranslationUnit(clang::ASTContext& context) override {
    const clang::SourceManager& sources = context.getSourceManager();
    std::vector<clang::Decl*> own;
    for (clang::Decl* declaration : context.getTranslationUnitDecl()->decls()) {
      // What a macro of a system header declares counts as ours where the macro is used in our
      // file.
      if (!sources.isInSystemHeader(declaration->getLocation())) {
        own.push_back(declaration);
      }
    }
    context.setTraversalScope(own);
  }
};

class NarrowTraversal : public clang::PluginASTAction {
 protected:
  std::unique_ptr<clang::ASTConsumer> CreateASTConsumer(clang::CompilerInstance& /*compiler*/,
                                                        llvm::StringRef /*file*/) override {
    return std::make_unique<OwnDeclarations>();
  }
  bool ParseArgs(const clang::CompilerInstance& /*compiler*/,
                 const std::vector<std::string>& /*arguments*/) override {
    return true;
  }
  ActionType getActionType() override { return AddBeforeMainAction; }
};

const clang::FrontendPluginRegistry::Add<NarrowTraversal> kRegistration(
    "own-declarations", "traverse what is not declared in a system header");

}  // namespace
