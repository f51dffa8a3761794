//! A CommonRoad file as plain data: lanelets and traffic signs with their ids and lines.

use std::mem;

use laneweave_network::Point;

use super::element::{Adjacent, LaneletElement, Sign};
use super::obstacle::StaticObstacle;
use super::rules;
use super::unused;
use crate::drawing::Crossing;
use crate::problem::Problem;
use crate::shape::MAXIMUM_COORDINATE;
use crate::unused::Unused;
use crate::xml::{Element, Visitor, XmlError, number, walk, with_point};

/// The roads of a CommonRoad file.
#[derive(Default)]
pub(super) struct Document {
    pub(super) lanelets: Vec<LaneletElement>,
    pub(super) signs: Vec<Sign>,
    pub(super) obstacles: Vec<StaticObstacle>,
    /// Latitude and longitude of its location [°]; the format has 999 for an unknown one.
    pub(super) place: [Option<f64>; 2],
    /// What traffic does not use.
    pub(super) unused: Unused,
    /// The kind of road that the scenario names, such as `urban`.
    pub(super) tags: Vec<String>,
}

/// The versions whose elements are known.
const VERSIONS: [&str; 2] = ["2018b", "2020a"];

/// Reads a CommonRoad file. Elements without a usable id become problems; unknown ones are ignored.
pub(super) fn parse(bytes: &[u8], problems: &mut Vec<Problem>) -> Result<Document, XmlError> {
    let mut drafts = Drafts { document: Document::default(), building: Building::Nothing, problems };
    walk(bytes, "commonRoad", &mut drafts)?;
    Ok(drafts.document)
}

/// A document that grows element by element.
struct Drafts<'a> {
    document: Document,
    building: Building,
    problems: &'a mut Vec<Problem>,
}

/// The element that is being read.
#[derive(Default)]
enum Building {
    #[default]
    Nothing,
    Lanelet(Box<LaneletElement>),
    Sign(Sign),
    Obstacle(Box<StaticObstacle>),
}

impl Visitor for Drafts<'_> {
    fn open(&mut self, path: &str, element: &Element) -> Result<(), XmlError> {
        match path {
            "" => self.root(element)?,
            "lanelet" => {
                if let Some(id) = self.id("lanelet", element)? {
                    let lanelet = LaneletElement { id, line: element.line, ..LaneletElement::default() };
                    self.building = Building::Lanelet(Box::new(lanelet));
                }
            }
            "trafficSign" => {
                if let Some(id) = self.id("traffic sign", element)? {
                    self.building = Building::Sign(Sign { id, line: element.line, shown: Vec::new() });
                }
            }
            "staticObstacle" | "obstacle" => {
                if let Some(id) = self.id("obstacle", element)? {
                    let obstacle = StaticObstacle::new(id, element.line, path == "staticObstacle");
                    self.building = Building::Obstacle(Box::new(obstacle));
                }
            }
            _ if !path.contains('/') || path == "lanelet/stopLine" => self.note_unused(path, element)?,
            _ => match (&mut self.building, path.split_once('/')) {
                (Building::Obstacle(obstacle), Some((_, part))) => obstacle.open(part),
                (Building::Lanelet(lanelet), Some(("lanelet", part))) => {
                    self.problems.extend(lanelet.open(part, element)?);
                }
                (Building::Sign(sign), Some(("trafficSign", "trafficSignElement"))) => {
                    sign.shown.push((String::new(), None));
                }
                (_, Some(("scenarioTags", tag))) if !tag.contains('/') => self.document.tags.push(tag.into()),
                _ => {}
            },
        }
        Ok(())
    }

    fn close(&mut self, path: &str, text: &str) {
        match (&mut self.building, path.split_once('/')) {
            (_, None) => match mem::take(&mut self.building) {
                Building::Lanelet(lanelet) => self.document.lanelets.push(*lanelet),
                Building::Sign(sign) => self.document.signs.push(sign),
                Building::Obstacle(it) if it.is_static => self.document.obstacles.push(*it),
                Building::Obstacle(_) => {}
                Building::Nothing => {}
            },
            (Building::Lanelet(lanelet), Some((_, part))) => {
                self.problems.extend(lanelet.close(part, text));
            }
            (Building::Sign(sign), Some((_, part))) => sign.close(part, text),
            (Building::Obstacle(obstacle), Some((_, part))) => obstacle.close(part, text, number(text)),
            (Building::Nothing, Some(("location", "gpsLatitude"))) => {
                self.document.place[0] = Some(number(text));
            }
            (Building::Nothing, Some(("location", "gpsLongitude"))) => {
                self.document.place[1] = Some(number(text));
            }
            (Building::Nothing, _) => {}
        }
    }
}

impl Drafts<'_> {
    fn root(&mut self, element: &Element) -> Result<(), XmlError> {
        let [version, tags] = element.values(["commonRoadVersion", "tags"])?;
        let version = version.unwrap_or_default();
        if !VERSIONS.contains(&version.as_ref()) {
            self.problems.push(Problem {
                element: "commonRoad".into(),
                line: Some(element.line),
                what: format!("its version {version:?} is unknown, so elements may be ignored"),
                remedy: format!("convert the file to {}", VERSIONS.join(" or ")),
            });
        }
        // Version 2018b has them here, version 2020a as elements.
        self.document.tags.extend(tags.iter().flat_map(|it| it.split_whitespace()).map(String::from));
        Ok(())
    }

    /// Counts an element that traffic does not use.
    fn note_unused(&mut self, path: &str, element: &Element) -> Result<(), XmlError> {
        if let Some((kind, name, meaning)) = unused::element(path) {
            let [id] = element.values(["id"])?;
            let of_lanelet = match &self.building {
                Building::Lanelet(lanelet) => Some(lanelet.id),
                _ => None,
            };
            let id = id.and_then(|it| it.parse().ok()).or(of_lanelet).unwrap_or_default();
            self.document.unused.add(&kind, (name, id, element.line), meaning);
        }
        Ok(())
    }

    fn id(&mut self, kind: &str, element: &Element) -> Result<Option<i64>, XmlError> {
        let [id] = element.values(["id"])?;
        let number = id.as_deref().and_then(|it| it.parse().ok());
        if number.is_none() {
            self.problems.push(Problem {
                element: format!("{kind} {}", id.unwrap_or_default()).trim_end().into(),
                line: Some(element.line),
                what: "its id is missing or not a whole number, so it is left out".into(),
                remedy: "give it an id of its own".into(),
            });
        }
        Ok(number)
    }
}

impl LaneletElement {
    /// Begins a point of a bound, or adds a reference.
    fn open(&mut self, part: &str, element: &Element) -> Result<Option<Problem>, XmlError> {
        const NOWHERE: Point = Point { x: f64::NAN, y: f64::NAN, z: 0.0 };
        match part {
            "leftBound/point" => self.left.points.push(NOWHERE),
            "rightBound/point" => self.right.points.push(NOWHERE),
            "predecessor" | "successor" | "adjacentLeft" | "adjacentRight" | "trafficSignRef" => {
                let [reference, direction] = element.values(["ref", "drivingDir"])?;
                let Some(id) = reference.as_deref().and_then(|it| it.parse().ok()) else {
                    let what = format!("the ref of its {part} is missing or not a whole number");
                    return Ok(Some(self.problem(what, "refer to the id of an element")));
                };
                match part {
                    "predecessor" => self.predecessors.push(id),
                    "successor" => self.successors.push(id),
                    "trafficSignRef" => self.signs.push(id),
                    _ => return Ok(self.add_adjacent(part, id, direction.as_deref())),
                }
            }
            _ => {}
        }
        Ok(None)
    }

    fn add_adjacent(&mut self, part: &str, id: i64, direction: Option<&str>) -> Option<Problem> {
        let same_direction = match direction {
            Some("same") => true,
            Some("opposite") => false,
            _ => {
                let what = format!("the drivingDir of its {part} {id} is neither same nor opposite");
                return Some(self.problem(what, "give the direction of the neighbour"));
            }
        };
        let place = if part == "adjacentLeft" { &mut self.adjacent_left } else { &mut self.adjacent_right };
        if place.is_some() {
            let what = format!("it has a further {part}, {id}, which is left out");
            return Some(self.problem(what, "give one neighbour on each side"));
        }
        *place = Some(Adjacent { id, same_direction });
        None
    }

    /// Reads the text of an element inside.
    fn close(&mut self, part: &str, text: &str) -> Option<Problem> {
        let (bound, part) = match part.split_once('/') {
            Some(("leftBound", part)) => (&mut self.left, part),
            Some(("rightBound", part)) => (&mut self.right, part),
            _ => return self.close_property(part, text),
        };
        if part == "lineMarking" {
            match rules::crossing(text) {
                Ok(crossing) => bound.crossing = crossing,
                Err(()) => {
                    bound.crossing = Some(Crossing::NEVER);
                    let what = format!("its line marking {text:?} is unknown and treated as a solid line");
                    return Some(
                        self.problem(what, "write dashed, solid or another of the format's markings"),
                    );
                }
            }
            return None;
        }
        let point = bound.points.last_mut()?;
        let coordinate = Some(number(text)).filter(|it| it.abs() <= MAXIMUM_COORDINATE).unwrap_or(f64::NAN);
        match part {
            "point/x" => point.x = coordinate,
            "point/y" => point.y = coordinate,
            "point/z" => point.z = coordinate,
            _ => return None,
        }
        let is_first = bound.points.len() == 1;
        let better = with_point(text).filter(|_| is_first)?;
        let what = format!("its {part} is {text:?}, with a decimal comma");
        Some(self.problem(what, &format!("write a point in all numbers, such as {better}")))
    }

    fn close_property(&mut self, part: &str, text: &str) -> Option<Problem> {
        match part {
            "laneletType" => {
                self.types.push(text.into());
                if !rules::is_type(text) {
                    let what = format!("its type {text:?} is unknown, so it is not used as a road");
                    return Some(self.problem(what, "write urban, highway or another of the format's types"));
                }
            }
            "userOneWay" => self.users.push(text.into()),
            "userBidirectional" => self.users_both_ways.push(text.into()),
            "speedLimit" => self.speed_limit = Some(number(text)),
            _ => {}
        }
        None
    }
}

impl Sign {
    /// Reads the text of an element inside.
    fn close(&mut self, part: &str, text: &str) {
        let Some((number_shown, value)) = self.shown.last_mut() else { return };
        match part {
            "trafficSignElement/trafficSignID" => *number_shown = text.into(),
            "trafficSignElement/additionalValue" => *value = value.or(Some(number(text))),
            _ => {}
        }
    }
}

#[cfg(test)]
mod tests {
    use laneweave_network::Side;

    use super::*;

    fn read(inside: &str) -> (Document, Vec<String>) {
        let mut problems = Vec::new();
        let text = format!("<commonRoad commonRoadVersion='2020a'>\n{inside}</commonRoad>");
        let document = parse(text.as_bytes(), &mut problems).unwrap();
        (document, problems.iter().map(Problem::to_string).collect())
    }

    #[test]
    fn lanelets_carry_what_the_file_says() {
        let (document, problems) = read(concat!(
            "<scenarioTags><urban><odd/></urban></scenarioTags>\n<lanelet id='7'>",
            "<leftBound><point><x>1</x><y> 2.5 </y><z>3</z></point>",
            "<lineMarking>dashed</lineMarking></leftBound>",
            "<rightBound><point><x>1</x><y>-</y></point><point><x>1e9</x></point></rightBound>",
            "<predecessor ref='1'/><successor ref='2'/><successor ref='3'/>",
            "<adjacentLeft ref='4' drivingDir='same'/><adjacentRight ref='5' drivingDir='opposite'/>",
            "<stopLine><lineMarking>solid</lineMarking><trafficSignRef ref='10'/></stopLine>",
            "<laneletType>urban</laneletType><userOneWay>car</userOneWay>",
            "<userBidirectional>bus</userBidirectional>",
            "<speedLimit>13.9</speedLimit><trafficSignRef ref='9'/></lanelet>\n",
            "<trafficSign id='9'><trafficSignElement><trafficSignID>274</trafficSignID>",
            "<additionalValue>8.3</additionalValue><additionalValue>9</additionalValue></trafficSignElement>",
            "<trafficSignElement><trafficSignID>R3-4</trafficSignID></trafficSignElement></trafficSign>",
        ));
        assert_eq!(problems, [""; 0]);
        assert_eq!(document.tags, ["urban"]);
        let lanelet = &document.lanelets[0];
        assert_eq!((lanelet.id, lanelet.line), (7, 3));
        assert_eq!(lanelet.left.points, [Point::new(1.0, 2.5, 3.0)]);
        assert_eq!(lanelet.left.crossing, Some(Crossing::BOTH_WAYS));
        let right = &lanelet.right;
        assert!(right.points[0].y.is_nan() && right.points[1].x.is_nan() && right.points[1].y.is_nan());
        assert_eq!((right.points[0].x, right.crossing), (1.0, None));
        assert_eq!((&lanelet.predecessors[..], &lanelet.successors[..]), (&[1][..], &[2, 3][..]));
        assert_eq!(lanelet.adjacent(Side::Left), Some(Adjacent { id: 4, same_direction: true }));
        assert_eq!(lanelet.adjacent(Side::Right), Some(Adjacent { id: 5, same_direction: false }));
        assert_eq!(
            (&lanelet.users[..], &lanelet.users_both_ways[..]),
            (&["car".into()][..], &["bus".into()][..])
        );
        assert_eq!((&lanelet.signs[..], lanelet.speed_limit), (&[9][..], Some(13.9)));
        assert_eq!(document.signs[0].line, 4);
        assert_eq!(document.signs[0].shown, [("274".into(), Some(8.3)), ("R3-4".into(), None)]);
    }

    #[test]
    fn what_cannot_be_understood_is_a_problem_with_its_line() {
        let (document, problems) = read(concat!(
            "<lanelet id='x'><successor ref='1'/></lanelet><trafficSign/>\n",
            "<lanelet id='1'><successor/><adjacentLeft ref='2'/>",
            "<adjacentRight ref='3' drivingDir='same'/><adjacentRight ref='4' drivingDir='same'/>",
            "<leftBound><lineMarking>wavy</lineMarking></leftBound>",
            "<laneletType>canal</laneletType></lanelet>",
        ));
        assert_eq!((document.lanelets.len(), document.signs.len()), (1, 0));
        assert_eq!(document.lanelets[0].left.crossing, Some(Crossing::NEVER));
        let starts = [
            "lanelet x (line 2): its id is missing or not a whole number",
            "traffic sign (line 2): its id is missing",
            "lanelet 1 (line 3): the ref of its successor is missing",
            "lanelet 1 (line 3): the drivingDir of its adjacentLeft 2 is neither same nor opposite",
            "lanelet 1 (line 3): it has a further adjacentRight, 4, which is left out",
            "lanelet 1 (line 3): its line marking \"wavy\" is unknown and treated as a solid line",
            "lanelet 1 (line 3): its type \"canal\" is unknown, so it is not used as a road",
        ];
        assert_eq!(problems.len(), starts.len());
        for (problem, start) in problems.iter().zip(starts) {
            assert!(problem.starts_with(start), "{problem}");
        }
    }

    #[test]
    fn other_versions_are_named() {
        let mut problems = Vec::new();
        let text = b"<commonRoad commonRoadVersion='2017a' tags='urban highway'/>";
        assert_eq!(parse(text, &mut problems).unwrap().tags, ["urban", "highway"]);
        assert_eq!(
            problems[0].to_string(),
            "commonRoad (line 1): its version \"2017a\" is unknown, so elements may be ignored; \
             convert the file to 2018b or 2020a"
        );
    }
}
