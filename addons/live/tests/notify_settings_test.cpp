#include "addons/live/notify_settings.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "addons/live/demo_model.hpp"
#include "addons/live/site.hpp"
#include "addons/live/tests/temporary_folder.hpp"

namespace spoolflow::live {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

class NotifySettingsTest : public InFolder {
 protected:
  void SetUp() override {
    InFolder::SetUp();
    write("m.json", std::string(demo_model().front().bytes));
    write("secret", "hidden42\n");
    write("empty", "\n");
  }
  [[nodiscard]] std::vector<NotifySettings> read(const std::string& lines) const {
    write("site.toml",
          "[[notify]]\n" + lines + "\n[[valve]]\nid = \"v\"\nmodel = \"m.json\"\nsource = { kind = \"rig\" }\n");
    return read_site(path("site.toml")).notify;
  }
  [[nodiscard]] std::string refused(const std::string& lines) const {
    return refusal([&] { (void)read(lines); });
  }
};

constexpr const char* mail = "mail = \"smtp://mail.example.org:587\"\nfrom = \"a@b.org\"\nto = [\"c@d.org\"]\n";

TEST_F(NotifySettingsTest, ReadsWebhookAndMailWithSecretsFromElsewhere) {
  ::setenv("SPOOLFLOW_TEST_HOOK", "https://hooks.example.org/T0/hidden42", 1);
  const auto hook = read(
      "webhook_environment = \"SPOOLFLOW_TEST_HOOK\"\ntoken_file = \"secret\"\nleast_priority = \"C\"\ngather_s = 2");
  ASSERT_EQ(hook.size(), 1U);
  EXPECT_FALSE(hook[0].is_mail());
  EXPECT_EQ(hook[0].name, "webhook at hooks.example.org");
  EXPECT_EQ(hook[0].url, "https://hooks.example.org/T0/hidden42");
  EXPECT_EQ(hook[0].token, "hidden42");
  EXPECT_EQ(hook[0].least, monitor::Ne107::function_check);
  EXPECT_EQ(hook[0].gather_s, 2);
  const auto letters = read(std::string(mail) + "user = \"hall\"\npassword_file = \"secret\"");
  EXPECT_TRUE(letters[0].is_mail() && letters[0].encrypted);
  EXPECT_EQ(letters[0].name, "mail through mail.example.org");
  EXPECT_THAT(letters[0].to, ElementsAre("c@d.org"));
  EXPECT_EQ(letters[0].password, "hidden42");
  EXPECT_EQ(letters[0].least, monitor::Ne107::maintenance_required);
  EXPECT_FALSE(read(std::string(mail) + "tls = false")[0].encrypted);
  EXPECT_FALSE(read("webhook = \"http://127.0.0.1:8000/\"")[0].encrypted);
}

TEST_F(NotifySettingsTest, RefusesWhatCannotWorkAndShowsNoSecret) {
  EXPECT_THAT(refused("token_file = \"secret\""), HasSubstr("line 1: [[notify]] names no receiver"));
  EXPECT_THAT(refused("webhook = \"hooks.example.org\""), HasSubstr("must be https://HOST/PATH"));
  EXPECT_THAT(refused("webhook = \"https://anna:hidden42@example.org/\""),
              AllOf(HasSubstr("without user and password"), Not(HasSubstr("hidden42"))));
  EXPECT_THAT(refused("webhook_file = \"secret\""),
              AllOf(HasSubstr("what the secret holds is none"), Not(HasSubstr("hidden42"))));
  EXPECT_THAT(refused("webhook_file = \"empty\""), HasSubstr("the first line of"));
  EXPECT_THAT(refused("webhook_environment = \"SPOOLFLOW_NOT_SET\""),
              HasSubstr("the environment variable SPOOLFLOW_NOT_SET"));
  EXPECT_THAT(refused("webhook = \"http://example.org/\""), HasSubstr("has no TLS; write https://, or tls = false"));
  EXPECT_THAT(refused("webhook = \"http://example.org/\"\ntls = false\ntoken_file = \"secret\""),
              HasSubstr("a token would go to example.org unencrypted"));
  EXPECT_THAT(refused("webhook = \"https://example.org/\"\nleast_priority = \"high\""),
              HasSubstr("line 3: least_priority is \"high\"; allowed: \"M\", \"S\", \"C\" or \"F\""));
  EXPECT_THAT(refused("webhook = \"https://example.org/\"\nto = [\"a@b.org\"]"), HasSubstr("'to'"));
  EXPECT_THAT(refused("webhook = \"https://example.org/\"\ngather_s = 0"), HasSubstr("allowed: 0.1 to 3600 s"));
  EXPECT_THAT(refused("webhook = \"https://example.org/\"\nauthority = \"no.pem\""), HasSubstr("cannot be read"));
  EXPECT_THAT(refused("mail = \"mail.example.org\"\nfrom = \"a@b.org\"\nto = [\"c@d.org\"]"),
              HasSubstr("write smtp://HOST:587 (STARTTLS) or smtps://HOST:465"));
  EXPECT_THAT(refused("mail = \"smtp://h:587\"\nfrom = \"a@b.org\""), HasSubstr("mail needs its recipients"));
  EXPECT_THAT(refused("mail = \"smtp://h:587\"\nfrom = \"a@b.org\\r\\nBcc: x\"\nto = [\"c@d.org\"]"),
              HasSubstr("is no mail address"));
  EXPECT_THAT(refused(std::string(mail) + "user = \"hall\""), HasSubstr("go together"));
  EXPECT_THAT(refused(std::string(mail) + "user = \"hall\"\npassword_file = \"secret\"\ntls = false"),
              HasSubstr("a password would go to mail.example.org unencrypted"));
}

}  // namespace
}  // namespace spoolflow::live
