# The figures of the study, each drawn from files alone. All figure rules, here and in other files,
# are the first one with other files and other words.


rule plot_problem:
    input:
        fall=trajectory(*STUDY.shown_fall),
    output:
        **drawn("problem"),
    log:
        "results/logs/plot_problem.log",
    benchmark:
        "results/benchmarks/plot_problem.tsv"
    group:
        "figures"
    conda:
        "../../envs/figures.yaml"
    threads: 1
    resources:
        mem_mb=1000,
        runtime=5,
    params:
        code=code_of("plot_problem"),
        call=drawn_from("plot_problem", "{fall}"),
    message:
        "draw the problem"
    shell:
        "sedfiber {params.call} --svg {output.svg} --png {output.png} > {log} 2>&1"


use rule plot_problem as plot_shapes_by_angle with:
    input:
        dataset="results/dataset/train.parquet",
    output:
        **drawn("shapes_by_angle"),
    log:
        "results/logs/plot_shapes_by_angle.log",
    benchmark:
        "results/benchmarks/plot_shapes_by_angle.tsv"
    params:
        code=code_of("plot_shapes_by_angle"),
        call=drawn_from("plot_shapes_by_angle", "{dataset}", f"--B {STUDY.shown_fall[0]}"),
    message:
        "draw the shapes along the falls of one ℬ"


use rule plot_problem as plot_centre_paths with:
    input:
        dataset="results/dataset/train.parquet",
    output:
        **drawn("centre_paths"),
    log:
        "results/logs/plot_centre_paths.log",
    benchmark:
        "results/benchmarks/plot_centre_paths.tsv"
    params:
        code=code_of("plot_centre_paths"),
        call=drawn_from("plot_centre_paths", "{dataset}", f"--B {STUDY.shown_fall[0]}"),
    message:
        "draw the paths of the centre bead at one ℬ"


use rule plot_problem as plot_shapes_by_flexibility with:
    input:
        dataset="results/dataset/train.parquet",
        regimes="results/tables/regimes.csv",
    output:
        **drawn("shapes_by_flexibility"),
    log:
        "results/logs/plot_shapes_by_flexibility.log",
    benchmark:
        "results/benchmarks/plot_shapes_by_flexibility.tsv"
    params:
        code=code_of("plot_shapes_by_flexibility"),
        call=drawn_from(
            "plot_shapes_by_flexibility",
            "{dataset}",
            "{regimes}",
            f"--angle-index {STUDY.shown_fall[1]}",
        ),
    message:
        "draw the shapes from one angle, and their regimes"


use rule plot_problem as plot_data_sets with:
    input:
        table="results/tables/trajectories.csv",
    output:
        **drawn("data_sets"),
    log:
        "results/logs/plot_data_sets.log",
    benchmark:
        "results/benchmarks/plot_data_sets.tsv"
    params:
        code=code_of("plot_data_sets"),
        call=drawn_from("plot_data_sets", "{table}"),
    message:
        "draw which fall belongs to which data set"


use rule plot_problem as plot_model_diagram with:
    input:
        card=model_files("results/models/forecast")[1],
    output:
        **drawn("model_diagram"),
    log:
        "results/logs/plot_model_diagram.log",
    benchmark:
        "results/benchmarks/plot_model_diagram.tsv"
    params:
        code=code_of("plot_model_diagram"),
        call=drawn_from("plot_model_diagram", "{card}"),
    message:
        "draw the parts of the reduced model"


use rule plot_problem as plot_reconstruction with:
    input:
        table="results/tables/reconstruction.csv",
    output:
        **drawn("reconstruction"),
    log:
        "results/logs/plot_reconstruction.log",
    benchmark:
        "results/benchmarks/plot_reconstruction.tsv"
    params:
        code=code_of("plot_reconstruction"),
        call=drawn_from("plot_reconstruction", "{table}"),
    message:
        "draw the reconstruction loss, and the four variants"
