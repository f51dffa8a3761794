//! Simulations of SUMO: their configuration, vehicles and outputs, on a net by hand.

use crate::command::mistakes::refusal;
use crate::command::program::Folder;

/// A street from west to east, and one from the south that joins it under a light.
const NET: &str = include_str!("../../../../../fuzz/seeds/sumo_net/light.net.xml");
const CONFIGURATION: &str = r#"<configuration>
    <input>
        <net-file value="town.net.xml"/>
        <route-files value="town.rou.xml"/>
        <additional-files value="town.add.xml"/>
    </input>
    <time><begin value="100"/><end value="400"/></time>
    <processing><time-to-teleport value="-1"/></processing>
</configuration>"#;
const ROUTES: &str = r#"<routes>
    <vType id="brisk" accel="3" sigma="0" maxSpeed="30" lcAssertive="2"/>
    <vType id="tram" vClass="tram"/>
    <route id="along" edges="a b"/>
    <vehicle id="early" type="brisk" route="along" depart="50"/>
    <vehicle id="one" type="brisk" route="along" depart="110" departSpeed="max"/>
    <vehicle id="&quot;two&quot;" depart="120" departLane="best"><route edges="c b"/></vehicle>
    <trip id="free" type="cars" from="a" to="b" depart="130"/>
    <trip id="round" type="cars" from="a" via="b" to="b" depart="135"/>
    <flow id="often" type="cars" from="c" to="b" begin="140" end="200" period="10"/>
    <vehicle id="rails" type="tram" route="along" depart="150"/>
    <vehicle id="lost" route="nowhere" depart="150"/>
    <vehicle id="b line" type="bus" route="along" depart="160"><stop busStop="stop" duration="10" until="220"/></vehicle>
    <person id="p" depart="0"/>
</routes>"#;
const ADDITIONAL: &str = r#"<additional>
    <vTypeDistribution id="cars"><vType id="c1" probability="0.3"/><vType id="c2" probability="0.7"/></vTypeDistribution>
    <vType id="bus" vClass="bus"/>
    <busStop id="stop" lane="b_0" startPos="40" endPos="60"/>
    <tlLogic id="J" programID="1"><phase duration="20" state="Gr"/><phase duration="20" state="rG"/></tlLogic>
</additional>"#;

fn folder() -> Folder {
    let folder = Folder::new().with("town.net.xml", NET).with("town.sumocfg", CONFIGURATION);
    folder.with("town.rou.xml", ROUTES).with("town.add.xml", ADDITIONAL)
}

#[test]
fn a_configuration_runs_and_its_outputs_have_the_names_of_its_files() {
    let folder = folder();
    let run = folder.laneweave("run town.sumocfg --sumo tripinfo,fcd --record 1 --out out");
    assert_eq!(run.code(), 0, "{}", run.errors());
    let told = run.errors();
    for part in [
        "vehicle rails in town.rou.xml (line 11): vehicles of the class \"tram\", which do not drive here, 1 in all",
        "vehicle lost in town.rou.xml (line 12): vehicles whose route there is not, 1 in all",
        "element p in town.rou.xml (line 14): elements <person>, 1 in all: it is not read",
        "vType brisk in town.rou.xml (line 2): types with lcAssertive, 1 in all",
        "option of town.sumocfg (line 8): options time-to-teleport, 1 in all: it has no counterpart",
    ] {
        assert!(told.contains(part), "{part}: {told}");
    }
    assert!(
        run.text().contains("bus") && run.text().contains("1 departed, 1 stops served, 0 missed"),
        "{}",
        run.text()
    );
    assert!(!told.contains("the speed limit changes by more than half"), "{told}");
    let trips = folder.read("out/tripinfo.xml");
    for name in ["one", "&quot;two&quot;", "free", "round", "often.0", "often.5", "b line"] {
        assert_eq!(trips.matches(&format!("id=\"{name}\"")).count(), 1, "{name}: {trips}");
    }
    assert!(!trips.contains("early") && !trips.contains("often.6"));
    // Times are those of its files, and types its own. The bus rests until its timetable lets it go.
    let value = |id: &str, key: &str| {
        let trip = trips.split("<tripinfo ").find(|it| it.starts_with(&format!("id=\"{id}\""))).unwrap_or("");
        let value = trip.split(&format!(" {key}=\"")).nth(1).and_then(|it| it.split('"').next());
        value.unwrap_or_default().to_owned()
    };
    let time = |id: &str, key: &str| value(id, key).parse::<f64>().unwrap_or(f64::NAN);
    assert!((110.0..111.0).contains(&time("one", "depart")), "{trips}");
    assert!(time("b line", "arrival") > 220.0, "{trips}");
    assert_eq!([value("one", "vType"), value("b line", "vType")], ["brisk", "bus"]);
    assert_eq!(trips.matches("arrivalLane=\"b_0\"").count(), 11);
    let positions = folder.read("out/fcd.xml");
    assert!(positions.contains("lane=\"a_0\"") && positions.contains("<timestep time=\"110.00\""));
    // The saved scenario names the same files.
    let again = folder.laneweave("run out/scenario.toml --out again");
    let hash = |text: &str| text.lines().find(|it| it.contains("state hash")).map(str::to_owned);
    assert_eq!((again.code(), hash(&again.text())), (0, hash(&run.text())), "{}", again.errors());
}

#[test]
fn drivers_have_the_styles_that_are_given_in_place_of_their_types() {
    let folder = folder();
    let summary = folder.summary("town.sumocfg --style aggressive=1 --record 0");
    assert_eq!(summary["completed"], 11);
    let text = folder.laneweave("run town.sumocfg --style aggressive=1 --record 0").text();
    assert!(text.contains("100.0 % aggressive"), "{text}");
}

#[test]
fn broken_files_are_told_with_their_place() {
    let cut = &ROUTES[..ROUTES.len() / 2];
    let endless = "<additional><include href=\"town.add.xml\"/></additional>";
    for (file, text, expected) in [
        ("town.rou.xml", cut, "town.rou.xml:8: not well-formed XML"),
        ("town.add.xml", endless, "town.add.xml:1: files include each other without end"),
        ("town.rou.xml", "<routes/>", "no vehicle of its files drives while it is simulated"),
        ("town.sumocfg", "<configuration/>", "town.sumocfg: it names no net-file"),
        (
            "town.sumocfg",
            "<configuration><net-file value='town.net.xml'/><route-files value='town.rou'/></configuration>",
            "town.rou",
        ),
    ] {
        let folder = folder().with(file, text);
        let told = refusal(&folder, "run town.sumocfg --record 0");
        assert!(told.contains(expected), "{expected}: {told}");
    }
}
