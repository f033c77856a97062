// A plugin of clang-tidy 14, loaded by tests/lint: every check sees the declarations of the file
// that is linted and no others. Without it clang-tidy walks through the standard library and all
// other headers for each file, which takes six times as long.
#include <clang-tidy/ClangTidyCheck.h>
#include <clang-tidy/ClangTidyModule.h>
#include <clang-tidy/ClangTidyModuleRegistry.h>
#include <clang/AST/ASTContext.h>
#include <clang/ASTMatchers/ASTMatchFinder.h>

namespace dripline::lint {
namespace {

/// Matches the translation unit before anything in it is visited, and limits the visit.
class MainFileOnly final : public clang::tidy::ClangTidyCheck {
 public:
  using ClangTidyCheck::ClangTidyCheck;

  void registerMatchers(clang::ast_matchers::MatchFinder* finder) override {
    finder->addMatcher(clang::ast_matchers::translationUnitDecl(), this);
  }

  void check(const clang::ast_matchers::MatchFinder::MatchResult& result) override {
    std::vector<clang::Decl*> own;
    // "noload": the declarations of a precompiled header stay on disk.
    for (clang::Decl* declaration : result.Context->getTranslationUnitDecl()->noload_decls()) {
      const auto place = result.SourceManager->getExpansionLoc(declaration->getLocation());
      if (result.SourceManager->isInMainFile(place)) own.push_back(declaration);
    }
    result.Context->setTraversalScope(own);
  }
};

class Module final : public clang::tidy::ClangTidyModule {
 public:
  void addCheckFactories(clang::tidy::ClangTidyCheckFactories& factories) override {
    factories.registerCheck<MainFileOnly>("dripline-main-file-only");
  }
};

const clang::tidy::ClangTidyModuleRegistry::Add<Module> kRegistered("dripline", "the linted file");

}  // namespace
}  // namespace dripline::lint
