# SPDX-License-Identifier: Apache-2.0
"""Factories of plug-ins in two steps: a loader gives a factory, and what its method gives makes the endpoints."""

from __future__ import annotations

from follow_kit import CMAKE, CPP_HEAD, ROS2_CMAKE, ROS2_HEAD, ends, follow

from haros_ci.model.architecture import Architecture

#: A ROS 2 workspace: an interface with a factory template, two gadgets, and a host.
GADGETS = """
namespace crane {
class Cabin;
using CabinPtr = std::shared_ptr<Cabin>;
class Gadget {
public:
  RCLCPP_SMART_PTR_DEFINITIONS(Gadget)
  explicit Gadget(CabinPtr cabin) : cabin_(cabin), node_(std::dynamic_pointer_cast<rclcpp::Node>(cabin)) {}
  Gadget(CabinPtr cabin, const std::string & below)
  : cabin_(cabin), node_(rclcpp::Node::make_shared(below, std::dynamic_pointer_cast<rclcpp::Node>(cabin)->get_fully_qualified_name())) {}
  virtual ~Gadget() = default;
  virtual void lift() {}
  rclcpp::Node::SharedPtr get_node() const { return node_; }
protected:
  CabinPtr cabin_;
  rclcpp::Node::SharedPtr node_;
};
class Maker {
public:
  virtual ~Maker() = default;
  virtual Gadget::SharedPtr make(CabinPtr cabin) = 0;
};
template<typename T>
class MakerOf : public Maker {
public:
  Gadget::SharedPtr make(CabinPtr cabin) override { return std::make_shared<T>(cabin); }
};
class Hook : public Gadget {
public:
  explicit Hook(CabinPtr cabin) : Gadget(cabin, "hook") {
    load_ = node_->create_publisher<std_msgs::msg::String>("~/load", 1);
  }
  void lift() override { node_->create_publisher<std_msgs::msg::String>("~/lifted", 1); }
  rclcpp::Publisher<std_msgs::msg::String>::SharedPtr load_;
};
class Horn : public Gadget {
public:
  explicit Horn(CabinPtr cabin) : Gadget(cabin) {
    tone_ = node_->create_publisher<std_msgs::msg::String>("tone", 1);
  }
  rclcpp::Publisher<std_msgs::msg::String>::SharedPtr tone_;
};
class Unlisted : public Gadget {
public:
  explicit Unlisted(CabinPtr cabin) : Gadget(cabin) { node_->create_publisher<std_msgs::msg::String>("unlisted", 1); }
};
"""
CABIN = """
static bool matches(const std::string & pattern, const std::string & name)
{
  int found = fnmatch(pattern.c_str(), name.c_str(), FNM_CASEFOLD);
  return found == 0;
}
class Cabin : public rclcpp::Node {
public:
  Cabin() : rclcpp::Node("cabin"), makers_("p", "crane::Maker") {
    declare_parameter("deny", deny_);
    declare_parameter("allow", allow_);
    timer_ = create_wall_timer(std::chrono::seconds(1), [this]() { timer_->cancel(); begin(); });
  }
  bool allowed(const std::string & name) {
    for (auto & pattern : deny_) {
      if (matches(pattern, name)) {
        for (auto & other : allow_) {
          if (matches(other, name)) { return true; }
        }
        return false;
      }
    }
    return true;
  }
  Gadget::SharedPtr create(const std::string & name) {
    auto maker = makers_.createSharedInstance(name);
    return maker->make(std::static_pointer_cast<Cabin>(shared_from_this()));
  }
  void add(const std::string & name) {
    if (!allowed(name)) { return; }
    try {
      auto gadget = create(name);
      gadgets_.push_back(gadget);
    } catch (pluginlib::PluginlibException & error) { }
  }
  void begin() {
    get_parameter("deny", deny_);
    get_parameter("allow", allow_);
    if (deny_.empty() && !allow_.empty()) { deny_.emplace_back("*"); }
    %s
  }
  rclcpp::TimerBase::SharedPtr timer_;
  std::vector<std::string> deny_{%s};
  std::vector<std::string> allow_{%s};
  std::vector<Gadget::SharedPtr> gadgets_;
  pluginlib::ClassLoader<Maker> makers_;
};
}
int main(int argc, char ** argv) { rclcpp::init(argc, argv); rclcpp::spin(std::make_shared<crane::Cabin>()); }
"""
EVERY = "for (auto & name : makers_.getDeclaredClasses()) { add(name); }"
LAUNCH = """<launch><node pkg="p" exec="n"><param from="$(find-pkg-share p)/launch/deny.yaml"/></node></launch>"""
MAKERS = """<library path="n">
<class name="hook" type="crane::MakerOf&lt;crane::Hook&gt;" base_class_type="crane::Maker"/>
<class name="horn" type="crane::MakerOf&lt;crane::Horn&gt;" base_class_type="crane::Maker"/></library>"""


def cabin(
    deny: str = "", allow: str = "", begin: str = EVERY, gadgets: str = GADGETS, xml: str = MAKERS, yaml: str = ""
) -> Architecture:
    cmake = ROS2_CMAKE.format("p") + (
        "ament_auto_add_executable(n src/n.cpp)\npluginlib_export_plugin_description_file(p plugins.xml)\n"
        "ament_auto_package()\n"
    )
    text = ROS2_HEAD + gadgets + CABIN % (begin, deny, allow)
    files = {"p/CMakeLists.txt": cmake, "p/src/n.cpp": text, "p/plugins.xml": xml}
    if yaml:
        files |= {"p/launch/l.launch.xml": LAUNCH, "p/launch/deny.yaml": yaml}
    return follow(files, 2)


def publishers(found: Architecture, name: str = "p/n") -> list[str]:
    """The publishers that the code makes in the configuration *name*."""
    return sorted(
        end.name
        for each in found.configurations
        if each.name == name
        for node in each.nodes
        for end in ends(node)
        if not end.implicit
    )


def gaps(found: Architecture) -> list[str]:
    every = (node for each in found.configurations for node in each.nodes)
    return sorted({unknown.reason for node in every for unknown in node.unknowns if unknown.field == "endpoints"})


def test_what_the_factories_of_a_template_make_is_made() -> None:
    found = cabin()
    assert publishers(found) == ["/cabin/hook/load", "/tone"]
    assert not gaps(found)


def test_a_list_that_leaves_a_factory_out_leaves_out_what_it_makes() -> None:
    assert publishers(cabin('"ho?k"')) == ["/tone"]
    assert publishers(cabin('"*"')) == []
    assert publishers(cabin('"*"', '"hook"')) == ["/cabin/hook/load"]
    assert publishers(cabin("", '"hook"')) == ["/cabin/hook/load"]


def test_lists_of_a_launch_file() -> None:
    for names, made in (("deny: [hook]", ["/tone"]), ("allow: ['h*k']", ["/cabin/hook/load"])):
        found = cabin(yaml=f"/**:\n  ros__parameters:\n    {names}\n")
        assert publishers(found, "p/launch/l.launch.xml") == made


def test_the_host_of_a_product_calls_its_methods() -> None:
    begin = 'auto made = create("hook"); made->lift(); create("horn")->lift();'
    assert publishers(cabin(begin=begin)) == ["/cabin/hook/lifted", "/cabin/hook/load", "/tone"]


def test_a_factory_that_a_parameter_names() -> None:
    begin = 'declare_parameter("kind", "horn"); add(get_parameter("kind").as_string());'
    assert publishers(cabin(begin=begin)) == ["/tone"]


def test_a_factory_of_which_the_name_is_not_known_is_told() -> None:
    begin = "std::ifstream file(path()); std::string name; file >> name; add(name);"
    found = cabin(begin=begin)
    assert publishers(found) == []
    assert publishers(found, "p/n (plug-ins)") == ["/cabin/hook/load", "/tone"]
    assert any("a plug-in is loaded" in gap for gap in gaps(found))


def test_each_way_to_an_instance() -> None:
    whole = "std::static_pointer_cast<Cabin>(shared_from_this())"
    for way in (
        f'makers_.createUniqueInstance("horn")->make({whole});',
        f'Maker * maker = makers_.createUnmanagedInstance("horn"); maker->make({whole});',
        f'boost::shared_ptr<Maker> maker = makers_.createInstance("horn"); maker->make({whole});',
        f'std::map<std::string, std::shared_ptr<Maker>> all; all["x"] = makers_.createSharedInstance("horn"); all["x"]->make({whole});',
        f'auto own = std::make_unique<pluginlib::ClassLoader<Maker>>("p", "crane::Maker"); own->createSharedInstance("horn")->make({whole});',
        f'pluginlib::ClassLoader<Maker> own("p", "crane::Maker"); for (auto & n : own.getDeclaredClasses()) {{ if (n == "horn") {{ own.createUniqueInstance(n)->make({whole}); }} }}',
        f'if (makers_.isClassAvailable("horn")) {{ makers_.createSharedInstance("horn")->make({whole}); }}',
    ):
        assert publishers(cabin(begin=way)) == ["/tone"], way


def test_a_product_on_a_node_below_the_host() -> None:
    for made, name in (
        ('node_->create_sub_node("below")->create_publisher<std_msgs::msg::String>', "/below/tone"),
        ('std::make_shared<rclcpp::Node>("bell", "/deck")->create_publisher<std_msgs::msg::String>', "/deck/tone"),
        ('(new rclcpp::Node("bell", "deck"))->create_publisher<std_msgs::msg::String>', "/deck/tone"),
    ):
        other = GADGETS.replace(
            'tone_ = node_->create_publisher<std_msgs::msg::String>("tone"', f'tone_ = {made}("tone"'
        )
        assert publishers(cabin(gadgets=other)) == sorted(("/cabin/hook/load", name)), made


def test_a_template_that_a_description_names_by_an_alias() -> None:
    gadgets = GADGETS + "using HornMaker = MakerOf<Horn>;\n}\nnamespace crane {\n"
    xml = MAKERS.replace("crane::MakerOf&lt;crane::Horn&gt;", "crane::HornMaker")
    assert publishers(cabin(gadgets=gadgets, xml=xml)) == ["/cabin/hook/load", "/tone"]


def test_a_factory_that_is_no_template_with_an_argument() -> None:
    maker = """
class Plain : public Maker {
public:
  Gadget::SharedPtr make(CabinPtr cabin) override { return pick("horn", cabin); }
  Gadget::SharedPtr pick(const std::string & kind, CabinPtr cabin) {
    if (kind == "horn") { return std::make_shared<Horn>(cabin); }
    return nullptr;
  }
};
"""
    xml = MAKERS.replace("crane::MakerOf&lt;crane::Horn&gt;", "crane::Plain")
    assert publishers(cabin(gadgets=GADGETS + maker, xml=xml)) == ["/cabin/hook/load", "/tone"]


def test_a_factory_that_nothing_asks_makes_nothing() -> None:
    assert publishers(cabin(begin='auto maker = makers_.createSharedInstance("horn");')) == []
    assert publishers(cabin(begin="")) == []
    assert publishers(cabin(begin="for (auto & name : makers_.getDeclaredClasses()) { log(name); }")) == []


def test_a_class_that_no_description_names_is_not_made() -> None:
    found = cabin(begin='add("unlisted"); add("crane::MakerOf<crane::Unlisted>");')
    assert publishers(found) == []
    assert any("it is not in the workspace" in gap for gap in gaps(found))


def test_a_factory_of_another_base_is_not_among_the_classes() -> None:
    xml = MAKERS.replace(
        'type="crane::MakerOf&lt;crane::Horn&gt;" base_class_type="crane::Maker"',
        'type="crane::Horn" base_class_type="crane::Gadget"',
    )
    assert publishers(cabin(xml=xml)) == ["/cabin/hook/load"]


def test_a_factory_that_gives_nothing_makes_nothing() -> None:
    nothing = GADGETS.replace("return std::make_shared<T>(cabin);", "return nullptr;")
    assert publishers(cabin(gadgets=nothing)) == []
    guarded = cabin(gadgets=nothing, begin='auto made = create("hook"); if (made) { made->lift(); }')
    assert publishers(guarded) == []


def test_a_class_that_is_not_available_is_not_loaded() -> None:
    begin = 'if (makers_.isClassAvailable("whistle")) { add("whistle"); }'
    assert publishers(cabin(begin=begin)) == []


def test_of_a_base_outside_the_workspace_not_all_classes_are_known() -> None:
    outside = GADGETS.replace("class Maker {", "class MakerNearby {").replace("public Maker {", "public far::Maker {")
    xml = MAKERS.replace('base_class_type="crane::Maker"', 'base_class_type="far::Maker"')
    begin = 'pluginlib::ClassLoader<far::Maker> all("p", "far::Maker"); for (auto & n : all.getDeclaredClasses()) { all.createSharedInstance(n)->make(nullptr); }'
    gadgets = "namespace far { class Maker; }\n" + outside + "using Maker = far::Maker;\n"
    found = cabin(gadgets=gadgets, xml=xml, begin=begin)
    assert publishers(found) == []
    assert any("a plug-in is loaded" in gap for gap in gaps(found))


def test_plug_ins_of_tests_are_not_among_the_classes() -> None:
    files = {"p/test/probe.xml": MAKERS.replace('"hook"', '"probe"').replace("Hook", "Unlisted")}
    cmake = ROS2_CMAKE.format("p") + (
        "ament_auto_add_executable(n src/n.cpp)\npluginlib_export_plugin_description_file(p plugins.xml)\n"
        "pluginlib_export_plugin_description_file(p test/probe.xml)\nament_auto_package()\n"
    )
    text = ROS2_HEAD + GADGETS + CABIN % (EVERY, "", "")
    found = follow({"p/CMakeLists.txt": cmake, "p/src/n.cpp": text, "p/plugins.xml": MAKERS, **files}, 2)
    assert publishers(found) == ["/cabin/hook/load", "/tone"]


#: A host that takes the only class there is, if no parameter names one.
ONLY = """
std::string kind;
if (!get_parameter("kind", kind)) {
  auto & classes = makers_.getDeclaredClasses();
  if (classes.size() == 1) { kind = classes[0]; } else { return; }
}
add(kind);
"""


def test_the_only_class_that_there_is() -> None:
    one = MAKERS.replace(
        '<class name="hook" type="crane::MakerOf&lt;crane::Hook&gt;" base_class_type="crane::Maker"/>', ""
    )
    assert publishers(cabin(begin=ONLY, xml=one)) == ["/tone"]
    several = cabin(begin=ONLY)
    assert publishers(several) == []
    assert publishers(several, "p/n (plug-ins)") == ["/cabin/hook/load", "/tone"]


#: The same in ROS 1: plug-ins of a vehicle's bridge, which are made by factories or begin by themselves.
BRIDGE = """
#include <pluginlib/class_loader.h>
namespace ferry {
class Part {
public:
  virtual ~Part() {}
  virtual void begin(ros::NodeHandle & nh) = 0;
};
class PartMaker {
public:
  virtual ~PartMaker() {}
  virtual boost::shared_ptr<Part> make(const std::string & where) = 0;
};
template<class T>
class PartMakerOf : public PartMaker {
public:
  boost::shared_ptr<Part> make(const std::string & where) { return boost::make_shared<T>(where); }
};
class Rudder : public Part {
public:
  Rudder(const std::string & where) : where_(where) {}
  void begin(ros::NodeHandle & nh) { sub_ = nh.subscribe(where_ + "/angle", 1, &Rudder::turn, this); }
  void turn(const std_msgs::String::ConstPtr & angle) {}
  std::string where_;
  ros::Subscriber sub_;
};
class Lamp : public Part {
public:
  Lamp(const std::string & where) : nh_("~" + where) { pub_ = nh_.advertise<std_msgs::String>("lamp", 1); }
  void begin(ros::NodeHandle & nh) {}
  ros::NodeHandle nh_;
  ros::Publisher pub_;
};
}
"""
FERRY = """
int main(int argc, char ** argv) {
  ros::init(argc, argv, "n");
  ros::NodeHandle nh, own("~");
  pluginlib::ClassLoader<ferry::PartMaker> loader("p", "ferry::PartMaker");
  std::vector<std::string> skip;
  own.getParam("skip", skip);
  std::vector<boost::shared_ptr<ferry::Part> > parts;
  for (auto & name : loader.getDeclaredClasses()) {
    bool is_skipped = false;
    for (auto & each : skip) { if (each == name) { is_skipped = true; } }
    if (is_skipped) { continue; }
    boost::shared_ptr<ferry::Part> part = loader.createInstance(name)->make("aft");
    part->begin(nh);
    parts.push_back(part);
  }
  ros::spin();
}
"""
PARTS = """<library path="n">
<class name="p/Rudder" type="ferry::PartMakerOf<ferry::Rudder>" base_class_type="ferry::PartMaker"/>
<class name="p/Lamp" type="ferry::PartMakerOf<ferry::Lamp>" base_class_type="ferry::PartMaker"/></library>"""


def ferry(launch: str = "") -> dict[str, list[str]]:
    """The names of what the node makes, by kind."""
    manifest = '<package><name>p</name><export><p plugin="${prefix}/plugins.xml"/></export></package>'
    files = {
        "p/package.xml": manifest,
        "p/CMakeLists.txt": CMAKE.format("p") + "add_executable(n src/n.cpp)\n",
        "p/src/n.cpp": CPP_HEAD + BRIDGE + FERRY,
        "p/plugins.xml": PARTS,
    }
    if launch:
        files["p/launch/l.launch"] = launch
    node = follow(files, 1).configurations[0].nodes[0]
    return {kind: [end.name for end in ends(node, kind) if not end.implicit] for kind in ("publishers", "subscribers")}


def test_factories_of_ros_1() -> None:
    assert ferry() == {"publishers": ["/n/aft/lamp"], "subscribers": ["/aft/angle"]}


def test_a_factory_of_ros_1_that_a_list_leaves_out() -> None:
    launch = '<launch><node pkg="p" type="n" name="n"><rosparam param="skip">[p/Lamp]</rosparam></node></launch>'
    assert ferry(launch) == {"publishers": [], "subscribers": ["/aft/angle"]}
